# One static library a folder, one test program a folder: the two functions that every CMakeLists.txt here uses.

# aquarama_library(motion SOURCES a.cpp ... [LINK targets...] [PRIVATE targets...] [OPTIMISED])
# Folders include each other as "common/motion/repertoire.h". OPTIMISED: fast in every preset, and no contraction
# of a*b+c, so that every machine computes the same bits.
function(aquarama_library name)
  cmake_parse_arguments(ARG "OPTIMISED" "" "SOURCES;LINK;PRIVATE" ${ARGN})
  add_library(aquarama_${name} STATIC ${ARG_SOURCES})
  target_include_directories(aquarama_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(aquarama_${name} PUBLIC aquarama_options ${ARG_LINK} PRIVATE ${ARG_PRIVATE})
  target_compile_options(aquarama_${name} PRIVATE -ffp-contract=off)
  if(ARG_OPTIMISED)
    target_compile_options(aquarama_${name} PRIVATE -O3)
  endif()
endfunction()

# aquarama_program(master SOURCES main.cpp LINK targets...): the executable aquarama-master in build/PRESET/bin
function(aquarama_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(aquarama-${name} ${ARG_SOURCES})
  target_link_libraries(aquarama-${name} PRIVATE aquarama_options ${ARG_LINK})
  set_target_properties(aquarama-${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
  aquarama_version(aquarama-${name})
endfunction()

# aquarama_version(aquarama-master): writes what its --version says. When everything is configured: then it is known what
# the program links. The commit is compiled apart, so that a commit costs one small file and the linking of programs.
function(aquarama_version program)
  cmake_language(EVAL CODE "cmake_language(DEFER DIRECTORY [[${PROJECT_SOURCE_DIR}]] CALL aquarama_write_version ${program})")
endfunction()

function(aquarama_write_version program)
  aquarama_collect_links(${program} links)
  set(LIBRARIES "")
  foreach(library IN ITEMS
      "CLI11 CLI11::CLI11 CLI11_VERSION" "Eigen Eigen3::Eigen Eigen3_VERSION" "FFmpeg-libavcodec PkgConfig::FFMPEG FFMPEG_libavcodec_VERSION"
      "GLFW glfw glfw3_VERSION" "GLM glm::glm glm_VERSION" "Highway hwy::hwy hwy_VERSION" "libepoxy PkgConfig::EPOXY EPOXY_VERSION"
      "libpng PNG::PNG PNG_VERSION_STRING" "libwebp PkgConfig::WEBP WEBP_libwebp_VERSION" "NLopt PkgConfig::NLOPT NLOPT_VERSION"
      "OpenSSL OpenSSL::Crypto OPENSSL_VERSION" "OpenSubdiv OpenSubdiv::osdCPU OpenSubdiv_VERSION" "Protobuf protobuf::libprotobuf Protobuf_VERSION"
      "spdlog spdlog::spdlog spdlog_VERSION" "TinyGLTF TinyGLTF::TinyGLTF TinyGLTF_VERSION" "ZeroMQ cppzmq ZeroMQ_VERSION")
    separate_arguments(library)
    list(GET library 0 name)
    list(GET library 1 target)
    list(GET library 2 variable)
    if(target IN_LIST links)
      string(APPEND LIBRARIES ", ${name} ${${variable}}")
    endif()
  endforeach()
  string(REGEX REPLACE "^, " "" LIBRARIES "${LIBRARIES}")
  if(NOT TARGET aquarama_commit)
    add_custom_target(aquarama_write_commit BYPRODUCTS ${CMAKE_BINARY_DIR}/commit.cpp
      COMMAND ${CMAKE_COMMAND} -DFOLDER=${PROJECT_SOURCE_DIR} -DOUTPUT=${CMAKE_BINARY_DIR}/commit.cpp
        -P ${PROJECT_SOURCE_DIR}/cmake/WriteCommit.cmake)
    add_library(aquarama_commit OBJECT ${CMAKE_BINARY_DIR}/commit.cpp)
    add_dependencies(aquarama_commit aquarama_write_commit)
    target_link_libraries(aquarama_commit PRIVATE aquarama_options)
    set_target_properties(aquarama_commit PROPERTIES CXX_CLANG_TIDY "")
  endif()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/version.cpp.in ${CMAKE_BINARY_DIR}/${program}-version.cpp @ONLY)
  target_sources(${program} PRIVATE ${CMAKE_BINARY_DIR}/${program}-version.cpp)
  target_link_libraries(${program} PRIVATE aquarama_commit)
endfunction()

# Everything that a target links, itself or through others.
function(aquarama_collect_links target result)
  set(open ${target})
  set(seen "")
  while(open)
    list(POP_FRONT open next)
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" next "${next}")
    if(next IN_LIST seen)
      continue()
    endif()
    list(APPEND seen ${next})
    if(NOT TARGET ${next})
      continue()
    endif()
    foreach(property LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
      get_target_property(more ${next} ${property})
      if(more)
        list(APPEND open ${more})
      endif()
    endforeach()
  endwhile()
  set(${result} ${seen} PARENT_SCOPE)
endfunction()

# aquarama_test(motion SOURCES a_test.cpp ... [LINK targets...] [BUDGET seconds]): one program, one ctest row.
# BUDGET is how long the suite may take on two cores; it is printed beside what it took, and stops a hang.
function(aquarama_test name)
  cmake_parse_arguments(ARG "" "BUDGET" "SOURCES;LINK" ${ARGN})
  if(NOT ARG_BUDGET)
    set(ARG_BUDGET 60)
  endif()
  add_executable(aquarama_${name}_test ${ARG_SOURCES})
  target_link_libraries(aquarama_${name}_test PRIVATE aquarama_test_support ${ARG_LINK} GTest::gmock GTest::gtest_main)
  target_compile_options(aquarama_${name}_test PRIVATE -ffp-contract=off)
  set_target_properties(aquarama_${name}_test PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  add_test(NAME ${name} COMMAND aquarama_${name}_test)
  set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_BUDGET} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    ENVIRONMENT "AQUARAMA_BIN=${CMAKE_BINARY_DIR}/bin")
endfunction()
