# The one place that says how a Plumbline target is built: language level, warnings, include root,
# alias and install rules. No global flags are set, so a project that adds us as a subdirectory keeps
# its own.

include(GNUInstallDirs)

# Floating point as written: contraction into fused multiply-adds changes results between compilers
# and would break "same seed, same bits" across them.
set(PLUMBLINE_COMPILE_OPTIONS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
                              -Wdouble-promotion -Wold-style-cast -ffp-contract=off)
if(PLUMBLINE_WERROR)
  list(APPEND PLUMBLINE_COMPILE_OPTIONS -Werror)
endif()

function(plumbline_target_defaults target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE ${PLUMBLINE_COMPILE_OPTIONS})
endfunction()

# plumbline_library(NAME HEADERS … SOURCES … [PUBLIC_LIBRARIES …] [PRIVATE_LIBRARIES …])
#
# Creates plumbline_NAME with the alias plumbline::NAME. Its include root is NAME/include and nothing
# else, so that including another part's headers without linking it does not compile.
function(plumbline_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "HEADERS;SOURCES;PUBLIC_LIBRARIES;PRIVATE_LIBRARIES")
  set(target plumbline_${name})
  add_library(${target} STATIC ${arg_SOURCES})
  add_library(plumbline::${name} ALIAS ${target})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS include FILES ${arg_HEADERS})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  plumbline_target_defaults(${target})
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC_LIBRARIES} PRIVATE ${arg_PRIVATE_LIBRARIES})
endfunction()

# plumbline_cold(TARGET): for what spends its time in others' code, or none, so that -O3 costs a compiler half of
# its time and saves nobody any. In a release build, the one where it matters.
function(plumbline_cold target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()
