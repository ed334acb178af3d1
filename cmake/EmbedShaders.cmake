# cmake -DFOLDER=render_node/shaders -DSHARED="common/base/hash.h;..." -DOUTPUT=embedded_shaders.cpp -P
# EmbedShaders.cmake
# Writes every file of the folder, and the shared ones that shaders include, into one C++ source, each as a
# string literal of its own, since compilers limit the length of a literal.
file(GLOB files LIST_DIRECTORIES false ${FOLDER}/*)
list(APPEND files ${SHARED})
list(SORT files)
set(source "#include \"render_node/gl/program.h\"\n\n#include <array>\n\nnamespace aquarama::gl {\n\nnamespace {\n\n")
string(APPEND source "constexpr std::array kShaders{\n")
foreach(file IN LISTS files)
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(APPEND source "    EmbeddedShader{\"${name}\",\n                   R\"glsl(${text})glsl\"},\n")
endforeach()
string(APPEND source "};\n\n}  // namespace\n\n")
string(APPEND source "std::span<const EmbeddedShader> embeddedShaders() { return kShaders; }\n\n")
string(APPEND source "}  // namespace aquarama::gl\n")
file(WRITE ${OUTPUT} "${source}")
