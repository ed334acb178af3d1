# cmake -DROOT=. -DOUTPUT=source_digest.cpp -P SourceDigest.cmake
# Writes the SHA-256 of all sources of common and render_node, by name and content, as a C++ constant.
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/common/*.h ${ROOT}/common/*.cpp ${ROOT}/render_node/*.h
  ${ROOT}/render_node/*.cpp)
list(SORT files)
set(all "")
foreach(file IN LISTS files)
  file(SHA256 ${ROOT}/${file} digest)
  string(APPEND all "${file} ${digest}\n")
endforeach()
string(SHA256 digest "${all}")
file(WRITE ${OUTPUT} "#include \"common/base/derived_cache.h\"\n\nnamespace aquarama {\n\n\
std::string_view sourceDigest() {\n    return \"${digest}\";\n}\n\n}  // namespace aquarama\n")
