# cmake -D OUTPUT=FILE.c -D HEADER=PATH.h -D NAMES=a;b -D FILES=x;y -P embed.cmake: writes FILE.c, in which `const char a[]` is the contents
# of the file x as a string, and so on, declared in the header.
set(source "/* Made from ${FILES} by embed.cmake. */\n#include \"${HEADER}\"\n")
foreach(name file IN ZIP_LISTS NAMES FILES)
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND source "\nconst char ${name}[] = {${bytes}0};\n")
endforeach()
file(WRITE ${OUTPUT} "${source}")
