# Writes a header with the commit of a source tree: cmake -DSOURCE=DIR -DHEADER=FILE -P commit.cmake
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
    set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define DIP_PEER_COMMIT \"@commit@\"\n" @ONLY)
