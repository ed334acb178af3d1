# cmake -DFOLDER=source -DOUTPUT=commit.cpp -P WriteCommit.cmake
# Names the commit of a git checkout, with "and changes" where files differ from it. Also names a time before which no
# clock can be right: SOURCE_DATE_EPOCH (reproducible packages), else that of the commit, else that of the changelog. An
# unchanged file is left alone, so that nothing is compiled or linked again.
cmake_minimum_required(VERSION 3.24)
set(commit unknown)
file(TIMESTAMP ${FOLDER}/CHANGELOG.md built "%s" UTC)
find_package(Git QUIET)
if(GIT_FOUND AND EXISTS ${FOLDER}/.git)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --abbrev=12 --exclude=* "--dirty= and changes"
    WORKING_DIRECTORY ${FOLDER} OUTPUT_VARIABLE said RESULT_VARIABLE failed ERROR_QUIET
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed)
    set(commit "${said}")
    execute_process(COMMAND ${GIT_EXECUTABLE} log -1 --format=%ct WORKING_DIRECTORY ${FOLDER} OUTPUT_VARIABLE built
      ERROR_QUIET
      OUTPUT_STRIP_TRAILING_WHITESPACE)
  endif()
endif()
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  set(built "$ENV{SOURCE_DATE_EPOCH}")
endif()
if(NOT built MATCHES "^[0-9]+$")
  set(built 0)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT
"// Written by cmake/WriteCommit.cmake.
#include <cstdint>

namespace aquarama {
std::int64_t builtAt();
std::int64_t builtAt() {
    return @built@;
}
}  // namespace aquarama

namespace aquarama::cli {
extern const char* const kCommit;
const char* const kCommit = \"@commit@\";
}  // namespace aquarama::cli
")
