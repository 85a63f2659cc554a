# Writes OUTPUT, a C++ file with the text of every file in SHADERS (separated by |).
#   cmake -DOUTPUT=... -DSHADERS=a|b -P embed_shaders.cmake
string(REPLACE "|" ";" shaders "${SHADERS}")
set(text "#include \"viewer/gl/gl_program.hpp\"\n\n#include <cassert>\n\nnamespace relevo::viewer {\n\n")
string(APPEND text "std::string_view shader_text(std::string_view file) {\n")
foreach(shader IN LISTS shaders)
  get_filename_component(name ${shader} NAME)
  file(READ ${shader} source)
  string(APPEND text "    if (file == \"${name}\") return R\"glsl(${source})glsl\";\n")
endforeach()
string(APPEND text "    assert(false);\n    return {};\n}\n\n}  // namespace relevo::viewer\n")
file(WRITE ${OUTPUT} "${text}")
