# Writes all declarations of the public headers to one file without directives of the preprocessor,
# which is what foreign-function interfaces such as Python's cffi read.
#
# Usage: cmake -DCOMPILER=<C compiler> -DSOURCE_DIR=<this tree> -DHEADERS=<headers, from the top of
#     the tree, separated by commas> -DFOLDER=<folder for temporary files> -DOUTPUT=<file>
#     -P flat_header.cmake
string(REPLACE "," ";" HEADERS "${HEADERS}")
set(includes "")
foreach(header IN LISTS HEADERS)
    string(APPEND includes "#include \"${header}\"\n")
endforeach()
file(WRITE ${FOLDER}/headers.c "${includes}")
# Empty files take the place of the system's headers: their types are known to every reader.
foreach(name limits math stdatomic stdbool stddef stdint stdio stdlib string)
    file(WRITE ${FOLDER}/system/${name}.h "")
endforeach()
execute_process(
    COMMAND ${COMPILER} -std=c17 -E -P -nostdinc -I${FOLDER}/system -I${SOURCE_DIR}
        "-D__attribute__(x)=" -Datomic_bool=bool ${FOLDER}/headers.c
    OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)

# Inline functions are not in the libraries, and numbers that depend on sizes cannot be read.
string(REGEX REPLACE "static inline[^{;]*{\n( [^\n]*\n|\n)*}\n" "" text "${text}")
string(REGEX REPLACE "enum { [A-Z_]+ = sizeof[^;]*;\n" "" text "${text}")
file(WRITE ${OUTPUT} "/* All declarations of Diptych's libraries, made from the public headers, for\n"
    "   foreign-function interfaces such as Python's cffi. Programs in C include the headers. */\n"
    "${text}")
