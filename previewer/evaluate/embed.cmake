# Writes OUTPUT, a C++ file with a function for the text of every one of FILES: the function of
# "report.html" is embedded::report_html(). HEADER declares them.
set(text "// Generated; do not edit.\n#include \"${HEADER}\"\n\nnamespace bounce::embedded {\n")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  string(REPLACE ".min" "" name "${name}")
  string(MAKE_C_IDENTIFIER "${name}" name)
  file(READ "${file}" content)
  string(APPEND text "\nstd::string_view ${name}() {\n    return R\"~bounce~(${content})~bounce~\";\n}\n")
endforeach()
string(APPEND text "\n}  // namespace bounce::embedded\n")
file(WRITE "${OUTPUT}" "${text}")
