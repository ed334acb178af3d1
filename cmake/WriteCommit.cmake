# cmake -DFOLDER=source -DOUTPUT=commit.cpp -P WriteCommit.cmake
# Names the commit of a git checkout, with "and changes" where files differ from it. An unchanged file is left alone, so
# that nothing is compiled or linked again.
cmake_minimum_required(VERSION 3.24)
set(commit unknown)
find_package(Git QUIET)
if(GIT_FOUND AND EXISTS ${FOLDER}/.git)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --abbrev=12 --exclude=* "--dirty= and changes"
    WORKING_DIRECTORY ${FOLDER} OUTPUT_VARIABLE said RESULT_VARIABLE failed ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed)
    set(commit "${said}")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT
"// Written by cmake/WriteCommit.cmake.
namespace aquarama::cli {
extern const char* const kCommit;
const char* const kCommit = \"@commit@\";
}  // namespace aquarama::cli
")
