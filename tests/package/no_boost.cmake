# No public header of verify pulls in Boost: a user's test file would take seconds more to compile.
# But for autodiff.h, which nothing else includes and who wants automatic differentiation
# asks for; it shows too that the preprocessor's answer can be yes.
#
# -DROOT=verify -DCOMPILER=… -DGTEST_INCLUDES=…

function(headers_of file result)
  set(flags -std=c++20 -M "-I${ROOT}/include")
  foreach(directory IN LISTS GTEST_INCLUDES)
    list(APPEND flags "-I${directory}") # -isystem /usr/include breaks include_next
  endforeach()
  execute_process(COMMAND "${COMPILER}" ${flags} -x c++ "${file}" RESULT_VARIABLE code
                  OUTPUT_VARIABLE out ERROR_VARIABLE error)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${file} does not compile by itself:\n${error}")
  endif()
  set(${result} "${out}" PARENT_SCOPE)
endfunction()

set(with_boost "${ROOT}/include/plumbline/verify/autodiff.h")
headers_of("${with_boost}" found)
if(NOT found MATCHES "/boost/")
  message(FATAL_ERROR "${with_boost} should be seen to include Boost")
endif()
file(GLOB_RECURSE headers "${ROOT}/include/*.h")
list(REMOVE_ITEM headers "${with_boost}")
list(LENGTH headers count)
if(count LESS 10)
  message(FATAL_ERROR "only ${count} public headers in ${ROOT}/include")
endif()
foreach(header IN LISTS headers)
  headers_of("${header}" found)
  if(found MATCHES "[^ ]*/boost/[^ ]*")
    message(SEND_ERROR "${header} includes ${CMAKE_MATCH_0}")
  endif()
endforeach()
