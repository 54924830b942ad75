# Configures, builds and runs the consumer in an empty directory, the way HOW says.
#
# Without a build type, hence without optimisation: the library is compiled once more for this.
#
# -DHOW=… -DSOURCE=tree -DBUILD=its build -DWORK=scratch -DGENERATOR=… -DCOMPILER=… -DLAUNCHER=…

function(step)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${code}:\n${out}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

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
