# cmake -DFILE=page.css -DNAMESPACE=aquarama::result -DNAME=kPageStyle -DOUTPUT=page_style.cpp -P EmbedText.cmake
# Writes a file of text into a C++ source, as a constant of this name.
file(READ ${FILE} text)
file(WRITE ${OUTPUT} "namespace ${NAMESPACE} {\n\nextern const char* const ${NAME};\n")
file(APPEND ${OUTPUT} "const char* const ${NAME} = R\"~text~(${text})~text~\";\n\n}  // namespace ${NAMESPACE}\n")
