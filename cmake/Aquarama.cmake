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
  add_test(NAME ${name} COMMAND ${PROJECT_SOURCE_DIR}/tests/support/timed.sh ${CMAKE_BINARY_DIR}/processor_time/${name}
    $<TARGET_FILE:aquarama_${name}_test>)
  set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_BUDGET} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    ENVIRONMENT "AQUARAMA_BIN=${CMAKE_BINARY_DIR}/bin")
endfunction()
