# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# The fuzzer. The tests include a short run and all inputs that ever failed; tools/fuzz makes long runs.

if(NOT TARGET codesign_cli)
  return()
endif()

file(GLOB fuzz_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/fuzz/*.cc)
set(fuzz_tests ${fuzz_sources})
list(FILTER fuzz_tests INCLUDE REGEX "_test\\.cc$")
list(FILTER fuzz_sources EXCLUDE REGEX "(_test|fuzz_main|request_fuzz)\\.cc$")

add_library(codesign_fuzzing STATIC EXCLUDE_FROM_ALL ${fuzz_sources})
target_include_directories(codesign_fuzzing PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/test)
target_link_libraries(codesign_fuzzing PUBLIC codesign_cli codesign_test_paths tinyxml2::tinyxml2 yaml-cpp nlohmann_json::nlohmann_json)
# Reads bags as the program does.
if(TARGET codesign_bag_module)
  target_sources(codesign_fuzzing PRIVATE ${PROJECT_SOURCE_DIR}/src/ros/loaded_bag_files.cc)
  target_link_libraries(codesign_fuzzing PRIVATE ${CMAKE_DL_LIBS})
  add_dependencies(codesign_fuzzing codesign_bag_module)
else()
  target_sources(codesign_fuzzing PRIVATE ${PROJECT_SOURCE_DIR}/src/cli/no_bag_files.cc)
endif()
codesign_warnings(codesign_fuzzing)
codesign_sanitize(codesign_fuzzing)

add_executable(codesign_fuzz EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/test/fuzz/fuzz_main.cc)
target_link_libraries(codesign_fuzz PRIVATE codesign_fuzzing)
if(TARGET codesign_ros)
  target_sources(codesign_fuzz PRIVATE ${PROJECT_SOURCE_DIR}/test/fuzz/request_fuzz.cc)
  target_link_libraries(codesign_fuzz PRIVATE codesign_ros)
  target_compile_definitions(codesign_fuzz PRIVATE CODESIGN_FUZZ_REQUESTS)
endif()
codesign_warnings(codesign_fuzz)
codesign_sanitize(codesign_fuzz)

add_executable(test_fuzz EXCLUDE_FROM_ALL ${fuzz_tests})
target_link_libraries(test_fuzz PRIVATE codesign_fuzzing GTest::gtest GTest::gtest_main)
codesign_warnings(test_fuzz)
codesign_add_test(fuzz test_fuzz 1 300)

set_target_properties(codesign_fuzz test_fuzz PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/test)
add_dependencies(tests codesign_fuzz test_fuzz)

file(GLOB fuzz_regressions CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/fuzz/regressions/*.yaml)
add_test(NAME fuzz_regressions COMMAND codesign_fuzz ${fuzz_regressions})
add_test(NAME fuzz_short COMMAND codesign_fuzz --inputs 400 --keep ${PROJECT_BINARY_DIR}/fuzz_failures)
set_tests_properties(fuzz_regressions fuzz_short PROPERTIES TIMEOUT 1500 LABELS unit)
add_dependencies(unit_tests codesign_fuzz)
