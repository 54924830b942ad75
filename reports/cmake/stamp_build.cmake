# Writes the header that tells a build where it comes from: -DOUTPUT -DSOURCE_DIR -DVERSION -DFLAGS.
# Run at every build; the file is touched only when what it says has changed.
find_package(Git QUIET)
set(commit unknown)
set(dirty false)
if(GIT_FOUND)
  execute_process(
    COMMAND "${GIT_EXECUTABLE}" -C "${SOURCE_DIR}" rev-parse HEAD
    OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit "${hash}")
    execute_process(COMMAND "${GIT_EXECUTABLE}" -C "${SOURCE_DIR}" status --porcelain
                    OUTPUT_VARIABLE changes ERROR_QUIET)
    if(changes)
      set(dirty true)
    endif()
  endif()
endif()
string(STRIP "${FLAGS}" flags)
string(REGEX REPLACE "([\\\\\"])" "\\\\\\1" flags "${flags}")

set(text
    "#pragma once
#define PLUMBLINE_VERSION \"${VERSION}\"
#define PLUMBLINE_COMMIT \"${commit}\"
#define PLUMBLINE_DIRTY ${dirty}
#define PLUMBLINE_FLAGS \"${flags}\"
")
set(known "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" known)
endif()
if(NOT known STREQUAL text)
  file(WRITE "${OUTPUT}" "${text}")
endif()
