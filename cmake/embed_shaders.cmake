# Writes OUTPUT, a C++ file with the text of every one of FILES (paths under ROOT).
set(text "// Generated from shaders/; do not edit.\n#include \"gl/shader_source.h\"\n\nnamespace bounce::gl {\n\n")
string(APPEND text "std::string_view embedded_shader(std::string_view path) {\n")
foreach(file ${FILES})
  file(READ ${ROOT}/${file} content)
  string(APPEND text "    if (path == \"${file}\") {\n        return R\"~~~(${content})~~~\";\n    }\n")
endforeach()
string(APPEND text "    return {};\n}\n\n}  // namespace bounce::gl\n")
file(WRITE ${OUTPUT} "${text}")
