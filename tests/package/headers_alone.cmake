# Every public header of verify compiles as the only one of a file, without a warning: what a user
# may include first, with whatever compiler and standard library.
#
# -DROOT=verify -DCOMPILER=… (or …-NOTFOUND) -DFLAGS=… -DINCLUDES=of GoogleTest and Boost

if(NOT COMPILER)
  message("SKIPPED: there is no clang++ here")
  return()
endif()
set(flags -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast -Werror ${FLAGS})

# Whether the standard library is there at all.
execute_process(COMMAND sh -c "echo '#include <version>' | '${COMPILER}' -x c++ -std=c++20 -fsyntax-only ${FLAGS} -"
                RESULT_VARIABLE code ERROR_QUIET)
if(NOT code EQUAL 0)
  message("SKIPPED: ${COMPILER} ${FLAGS} finds no standard library")
  return()
endif()

foreach(directory IN LISTS INCLUDES)
  if(NOT directory STREQUAL "/usr/include") # that breaks include_next
    list(APPEND flags -isystem "${directory}")
  endif()
endforeach()
file(GLOB_RECURSE headers RELATIVE "${ROOT}/include" "${ROOT}/include/*.h")
list(LENGTH headers count)
if(count LESS 10)
  message(FATAL_ERROR "only ${count} public headers in ${ROOT}/include")
endif()
foreach(header IN LISTS headers)
  execute_process(
    COMMAND sh -c "echo '#include <${header}>' | '${COMPILER}' -x c++ \"$@\" -" sh ${flags} "-I${ROOT}/include"
    RESULT_VARIABLE code ERROR_VARIABLE error)
  if(NOT code EQUAL 0)
    message(SEND_ERROR "${header} does not compile by itself with ${COMPILER} ${FLAGS}:\n${error}")
  endif()
endforeach()
message("${count} headers compile")
