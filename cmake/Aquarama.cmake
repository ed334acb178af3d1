# The functions that every CMakeLists.txt here uses. Each folder is one static library and has one test program.

# With CMAKE_UNITY_BUILD so many sources of a folder are compiled as one: what they include is parsed once, which takes
# about half the time. In a folder a name of an unnamed namespace therefore stands for one thing. A source still
# includes what it uses: the dev preset, by hand, and ./test --tidy compile each by itself.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 16)
if(CMAKE_UNITY_BUILD)  # GCC takes the sources for headers, and what is a source's own for a mistake
  add_compile_options(-Wno-subobject-linkage)
endif()

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

# aquarama_schema(config SOURCES rules.proto ... [LINK targets...]): the messages of a folder, as library
# aquarama_config_schema. A schema is imported, and its header included, from the root: "common/config/rules.proto".
# What
# protoc writes is compiled apart: our warnings and our linter are not its business.
function(aquarama_schema name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  file(RELATIVE_PATH FOLDER ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set(WRITTEN "")
  foreach(SCHEMA IN LISTS ARG_SOURCES)
    get_filename_component(BASE ${SCHEMA} NAME_WE)
    set(OUTPUTS ${CMAKE_BINARY_DIR}/${FOLDER}/${BASE}.pb.cc ${CMAKE_BINARY_DIR}/${FOLDER}/${BASE}.pb.h)
    add_custom_command(OUTPUT ${OUTPUTS}
      COMMAND protobuf::protoc --cpp_out=${CMAKE_BINARY_DIR} -I ${PROJECT_SOURCE_DIR} ${FOLDER}/${SCHEMA}
      WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} DEPENDS ${ARG_SOURCES} protobuf::protoc)
    list(APPEND WRITTEN ${OUTPUTS})
  endforeach()
  add_library(aquarama_${name}_schema STATIC ${WRITTEN})
  target_compile_features(aquarama_${name}_schema PUBLIC cxx_std_20)
  target_compile_options(aquarama_${name}_schema PRIVATE -w)
  target_include_directories(aquarama_${name}_schema SYSTEM PUBLIC ${CMAKE_BINARY_DIR})
  target_link_libraries(aquarama_${name}_schema PUBLIC protobuf::libprotobuf ${ARG_LINK})
  set_target_properties(aquarama_${name}_schema PROPERTIES CXX_CLANG_TIDY "" UNITY_BUILD OFF)
endfunction()

# aquarama_pages(console RESULT): in RESULT the source of aquarama::console::embeddedPages(), the files of ./pages.
function(aquarama_pages namespace result)
  file(GLOB_RECURSE PAGES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/pages/*)
  set(EMBEDDED ${CMAKE_CURRENT_BINARY_DIR}/embedded_pages.cpp)
  add_custom_command(OUTPUT ${EMBEDDED}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${CMAKE_CURRENT_SOURCE_DIR}/pages -DNAMESPACE=${namespace} -DOUTPUT=${EMBEDDED}
      -P ${PROJECT_SOURCE_DIR}/cmake/EmbedPages.cmake
    DEPENDS ${PAGES} ${PROJECT_SOURCE_DIR}/cmake/EmbedPages.cmake)
  set(${result} ${EMBEDDED} PARENT_SCOPE)
endfunction()

# aquarama_program(aquarama-node SOURCES main.cpp LINK targets...): an executable in build/PRESET/bin.
function(aquarama_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE aquarama_options ${ARG_LINK})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)  # a quarter faster to compile
  aquarama_version(${name})
endfunction()

# aquarama_version(aquarama): writes the text of its --version. It runs when everything is configured, since only then
# it is known what the program links. The commit is in a source of its own, so that after a commit only one small file
# is compiled and the programs are linked.
function(aquarama_version program)
  cmake_language(EVAL CODE
    "cmake_language(DEFER DIRECTORY [[${PROJECT_SOURCE_DIR}]] CALL aquarama_write_version ${program})")
endfunction()

function(aquarama_write_version program)
  aquarama_collect_links(${program} links)
  set(LIBRARIES "")
  foreach(library IN ITEMS
      "Avahi PkgConfig::AVAHI common/enrol AVAHI_VERSION"
      "CLI11 CLI11::CLI11 . CLI11_VERSION" "Eigen Eigen3::Eigen common Eigen3_VERSION"
      "FFmpeg-libavcodec PkgConfig::FFMPEG calibration/compose FFMPEG_libavcodec_VERSION"
      "GLFW glfw render_node glfw3_VERSION"
      "GLM glm::glm . glm_VERSION" "Highway hwy::hwy common hwy_VERSION"
      "libepoxy PkgConfig::EPOXY render_node EPOXY_VERSION"
      "libpng PNG::PNG common PNG_VERSION_STRING" "libjpeg-turbo PkgConfig::TURBOJPEG render_node TURBOJPEG_VERSION"
      "libcurl CURL::libcurl common/lease CURL_VERSION_STRING"
      "liblo PkgConfig::LIBLO common/osc LIBLO_VERSION" "libqrencode PkgConfig::QRENCODE guests QRENCODE_VERSION"
      "OLA PkgConfig::OLA console/cues OLA_VERSION"
      "libzip PkgConfig::LIBZIP common/formats LIBZIP_VERSION"
      "libwebp PkgConfig::WEBP calibration/compose WEBP_libwebp_VERSION"
      "nlohmann-json nlohmann_json::nlohmann_json capture/report nlohmann_json_VERSION"
      "NLopt PkgConfig::NLOPT capture NLOPT_VERSION" "OpenSSL OpenSSL::Crypto common OPENSSL_VERSION"
      "OpenSubdiv OpenSubdiv::osdCPU common OpenSubdiv_VERSION" "Protobuf protobuf::libprotobuf common Protobuf_VERSION"
      "pugixml pugixml::pugixml common/formats pugixml_VERSION"
      "spdlog spdlog::spdlog . spdlog_VERSION" "TinyGLTF TinyGLTF::TinyGLTF capture TinyGLTF_VERSION"
      "ZeroMQ cppzmq common ZeroMQ_VERSION")
    separate_arguments(library)
    list(GET library 0 name)
    list(GET library 1 target)
    list(GET library 2 folder)  # where find_package() is called for it
    list(GET library 3 variable)
    if(target IN_LIST links)
      get_directory_property(version DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DEFINITION ${variable})
      string(APPEND LIBRARIES ", ${name} ${version}")
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

# aquarama_collect_links(TARGET RESULT): everything that a target links, directly or through others.
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

# aquarama_test(motion [KIND] SOURCES a_test.cpp ... [LINK targets...]): one program, one ctest row.
function(aquarama_test name)
  cmake_parse_arguments(ARG "REAL_TIME;PATIENT;WAITS" "" "SOURCES;LINK" ${ARGN})
  add_executable(aquarama_${name}_test ${ARG_SOURCES})
  target_link_libraries(aquarama_${name}_test PRIVATE aquarama_test_support ${ARG_LINK} GTest::gmock GTest::gtest_main)
  target_compile_options(aquarama_${name}_test PRIVATE -ffp-contract=off)
  target_precompile_headers(aquarama_${name}_test REUSE_FROM aquarama_test_headers)
  set_target_properties(aquarama_${name}_test PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  set(KIND "")
  foreach(ONE REAL_TIME PATIENT WAITS)
    if(ARG_${ONE})
      set(KIND ${ONE})
    endif()
  endforeach()
  aquarama_suite(${name} ${KIND} COMMAND $<TARGET_FILE:aquarama_${name}_test>)
endfunction()

# aquarama_suite(motion [KIND] COMMAND command...): a ctest row whose processor time is compared with its line in
# tests/budgets.csv. The timeouts of the test presets are only for programs that hang. Software OpenGL draws with one
# thread. The user's cache of the programs is in the build folder. What runs at once, where ctest has four places for
# each processor:
#   REAL_TIME: processes wait for one another by the clock, on ports that others use too. One at a time, at first, and
#              beside it only one of the next kind and suites that compute.
#   PATIENT:   real processes too, which wait for most of the time and have minutes for each step. One at a time,
#              beside all others.
#   WAITS:     a clock counts, but nothing is drawn in time. Beside all but REAL_TIME.
#   none:      computes, and takes the processor when no other process wants it.
function(aquarama_suite name)
  cmake_parse_arguments(ARG "REAL_TIME;PATIENT;WAITS" "" "COMMAND" ${ARGN})
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/processor_time)
  set(WHEN "")
  if(NOT ARG_REAL_TIME AND NOT ARG_PATIENT AND NOT ARG_WAITS)
    set(WHEN chrt --idle 0)
  endif()
  add_test(NAME ${name} COMMAND ${PROJECT_SOURCE_DIR}/tests/support/timed.py ${CMAKE_BINARY_DIR}/processor_time/${name}
    ${WHEN} ${ARG_COMMAND})
  set(FOLDERS "XDG_CACHE_HOME=${CMAKE_BINARY_DIR}/cache;XDG_STATE_HOME=${CMAKE_BINARY_DIR}/state")
  set_tests_properties(${name} PROPERTIES WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    ENVIRONMENT "AQUARAMA_BIN=${CMAKE_BINARY_DIR}/bin;LP_NUM_THREADS=1;${FOLDERS}")
  if(ARG_REAL_TIME)
    set_tests_properties(${name} PROPERTIES PROCESSORS 5 RESOURCE_LOCK wall COST 3000)
  elseif(ARG_PATIENT)
    set_tests_properties(${name} PROPERTIES PROCESSORS 1 RESOURCE_LOCK patience COST 2000)
  elseif(ARG_WAITS)
    set_tests_properties(${name} PROPERTIES PROCESSORS 4 COST 1000)
  else()
    set_tests_properties(${name} PROPERTIES PROCESSORS 2)
  endif()
endfunction()
