# Makes a C source file with the bytes of a text file as a string:
#   cmake -DINPUT=page.css -DOUTPUT=page_css.c -DNAME=dip_cost_page_css -P embed.cmake
file(READ ${INPUT} digits HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${digits}")
string(REPEAT "0x..," 20 line)
string(REGEX REPLACE "(${line})" "\\1\n" bytes "${bytes}")
file(WRITE ${OUTPUT}
    "#include \"app/report/page/web/embedded.h\"\n\nconst unsigned char ${NAME}[] = {\n${bytes}0};\n")
