# Writes a project with `plumbline init`, builds it against the installed library, and runs it; or runs it under
# pytest, with the package of this build.
#
# -DLANGUAGE=cpp|python -DCOMMAND=plumbline -DBUILD=its build -DWORK=scratch -DGENERATOR=… -DCOMPILER=… -DPYTHON=…

include("${CMAKE_CURRENT_LIST_DIR}/step.cmake")

file(REMOVE_RECURSE "${WORK}")
step("${COMMAND}" init "${WORK}/project" --language "${LANGUAGE}")
if(LANGUAGE STREQUAL "cpp")
  step("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
  step("${CMAKE_COMMAND}" -S "${WORK}/project" -B "${WORK}/build" -G "${GENERATOR}"
       "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_PREFIX_PATH=${WORK}/prefix")
  step("${CMAKE_COMMAND}" --build "${WORK}/build")
  step("${CMAKE_CTEST_COMMAND}" --test-dir "${WORK}/build" --output-on-failure --no-tests=error)
else()
  set(ENV{PYTHONPATH} "${BUILD}/verify/python")
  set(ENV{PYTHONDONTWRITEBYTECODE} 1)
  step("${PYTHON}" -m pytest -q -p no:cacheprovider "${WORK}/project")
endif()
file(REMOVE_RECURSE "${WORK}")
