# Configures, builds and runs the consumer in an empty directory, the way HOW says.
#
# Without a build type, hence without optimisation: the library is compiled once more for this.
#
# -DHOW=… -DSOURCE=tree -DBUILD=its build -DWORK=scratch -DGENERATOR=… -DCOMPILER=… -DLAUNCHER=…

include("${CMAKE_CURRENT_LIST_DIR}/step.cmake")

file(REMOVE_RECURSE "${WORK}")
set(settings "-DHOW=${HOW}")
if(HOW STREQUAL "find_package")
  step("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
  list(APPEND settings "-DCMAKE_PREFIX_PATH=${WORK}/prefix")
else()
  list(APPEND settings "-DPLUMBLINE_SOURCE=${SOURCE}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}")
endif()
step("${CMAKE_COMMAND}" -S "${SOURCE}/tests/package/consumer" -B "${WORK}/build" -G "${GENERATOR}"
     "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}" ${settings})
step("${CMAKE_COMMAND}" --build "${WORK}/build")
step("${WORK}/build/consumer")
message("${out}")
file(REMOVE_RECURSE "${WORK}")
