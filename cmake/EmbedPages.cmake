# cmake -DFOLDER=console/pages -DNAMESPACE=console -DOUTPUT=embedded_pages.cpp -P EmbedPages.cmake
# Writes every file of the folder into one C++ source, by its path below it, with its SHA-256: a page and the program
# that serves it never differ.
file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*)
list(SORT files)
set(source "#include \"common/web/pages.h\"\n\n#include <array>\n\n")
string(APPEND source "namespace aquarama::${NAMESPACE} {\n\nnamespace {\n\n")
string(APPEND source "constexpr std::array kPages{\n")
foreach(file IN LISTS files)
  file(READ ${FOLDER}/${file} text)
  file(SHA256 ${FOLDER}/${file} digest)
  string(APPEND source "    web::EmbeddedPage{\"/${file}\", \"${digest}\", R\"~page~(${text})~page~\"},\n")
endforeach()
string(APPEND source "};\n\n}  // namespace\n\n")
string(APPEND source "std::span<const web::EmbeddedPage> embeddedPages();\n"
  "std::span<const web::EmbeddedPage> embeddedPages() { return kPages; }\n\n")
string(APPEND source "}  // namespace aquarama::${NAMESPACE}\n")
file(WRITE ${OUTPUT} "${source}")
