# Writes OUTPUT with the commit of the sources in SOURCE_DIR; leaves it untouched when nothing changed. Every build runs it.
cmake_minimum_required(VERSION 3.25)
set(MAMO_SOURCE_COMMIT unknown)
find_package(Git QUIET)
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE_DIR} describe --always --dirty --abbrev=40 --exclude=*
    OUTPUT_VARIABLE described RESULT_VARIABLE status OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(status EQUAL 0)
    set(MAMO_SOURCE_COMMIT ${described})
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define MAMO_SOURCE_COMMIT \"@MAMO_SOURCE_COMMIT@\"\n" @ONLY)
