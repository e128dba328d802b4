# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# One gtest executable per folder of test/, rostests, and the test of the layering.
# `tests` (catkin's target) builds them; `ctest` runs them. Without ROS only the tests of the core and of tools are there.

find_package(GTest REQUIRED)
find_package(orocos_kdl QUIET)

# Absolute paths reach the tests through one object alone: all others are the same in every checkout, for a compiler cache.
add_library(codesign_test_paths OBJECT EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/test/paths.cc)
target_compile_definitions(codesign_test_paths PRIVATE CODESIGN_SOURCE_DIR="${PROJECT_SOURCE_DIR}" CODESIGN_EXECUTABLE="$<TARGET_FILE:codesign>"
  CODESIGN_MPIRUN="$<$<BOOL:${MPI_C_FOUND}>:${MPIEXEC_EXECUTABLE}>")
codesign_warnings(codesign_test_paths)

# All programs of tests and what they start, for tools/sanitize.
add_custom_target(unit_tests)
# Registers an executable as a few tests, each of which runs its share of the cases in one process. For one case:
# build/test/test_ROOM --gtest_filter=NAME
function(codesign_add_test name target shards timeout)
  add_dependencies(unit_tests ${target})
  math(EXPR last "${shards} - 1")
  # Sanitized code takes several times as long.
  if(CODESIGN_SANITIZE)
    math(EXPR timeout "${timeout} * 4")
  endif()
  foreach(shard RANGE ${last})
    math(EXPR number "${shard} + 1")
    add_test(NAME ${name}.${number}_of_${shards} COMMAND ${target})
    set_tests_properties(${name}.${number}_of_${shards} PROPERTIES
      TIMEOUT ${timeout} LABELS unit ENVIRONMENT "GTEST_TOTAL_SHARDS=${shards};GTEST_SHARD_INDEX=${shard}")
  endforeach()
endfunction()

# What every test compiles with. Its precompiled header is the other tests'.
add_library(codesign_test_settings INTERFACE)
target_include_directories(codesign_test_settings INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/test)
target_link_libraries(codesign_test_settings INTERFACE codesign_core GTest::gtest SUNDIALS::idas NLopt::nlopt codesign_klu tinyxml2::tinyxml2
  console_bridge::console_bridge yaml-cpp nlohmann_json::nlohmann_json)
# The least time to compile; the code under test is optimized all the same.
if(CMAKE_BUILD_TYPE STREQUAL Release OR CODESIGN_SANITIZE)
  target_compile_options(codesign_test_settings INTERFACE -O0)
endif()
# Fixtures that several rooms' tests share: what is in the rooms' folders beside their tests, compiled once. Machines in one unit, the rest in another.
file(GLOB_RECURSE fixtures CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/*.cc)
list(FILTER fixtures EXCLUDE REGEX "_test\\.cc$|/test/(fuzz|ros|cli|allocation)/|/paths\\.cc$")
set(machine_fixtures ${fixtures})
list(FILTER machine_fixtures INCLUDE REGEX "/test/(equations|integration|sensitivity|cases|ensemble)/")
list(APPEND fixtures ${PROJECT_SOURCE_DIR}/benchmark/mechanisms.cc)
add_library(codesign_test_fixtures STATIC EXCLUDE_FROM_ALL ${fixtures})
codesign_unite(codesign_test_fixtures fixtures ${fixtures})
codesign_unite(codesign_test_fixtures machine_fixtures ${machine_fixtures})
target_link_libraries(codesign_test_fixtures PUBLIC codesign_test_settings)
codesign_warnings(codesign_test_fixtures)
codesign_precompile(codesign_test_fixtures <gtest/gtest.h>)

# Files whose names for small things are also those of a neighbour compile alone.
set(alone math/scalar_test.cc reading/urdf/vocabulary_check_test.cc)
set(many_cases reading elements equations integration sensitivity cli ros cases)
foreach(folder IN LISTS codesign_rooms ITEMS mpi cli ros benchmark cases allocation)
  file(GLOB_RECURSE test_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/${folder}/*.cc)
  list(FILTER test_sources INCLUDE REGEX "_test\\.cc$|/allocation/")
  if(NOT test_sources OR (folder STREQUAL ros AND NOT TARGET codesign_ros))
    continue()
  endif()
  # It counts with a malloc() of its own, in the place of the sanitizer's.
  if(folder STREQUAL allocation AND CODESIGN_SANITIZE)
    continue()
  endif()
  set(target test_${folder})
  add_executable(${target} EXCLUDE_FROM_ALL ${test_sources})
  target_link_libraries(${target} PRIVATE codesign_test_fixtures codesign_test_paths GTest::gtest_main)
  # Units of twelve files or 60 kB at most, so that a developer who edits one file need not wait longer.
  set(group 0)
  set(files 0)
  set(bytes 0)
  foreach(file IN LISTS test_sources)
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR}/test ${file})
    if(name IN_LIST alone)
      continue()
    endif()
    file(SIZE ${file} size)
    math(EXPR files "${files} + 1")
    math(EXPR bytes "${bytes} + ${size}")
    if(files GREATER 12 OR (files GREATER 1 AND bytes GREATER 60000))
      math(EXPR group "${group} + 1")
      set(files 1)
      set(bytes ${size})
    endif()
    codesign_unite(${target} ${folder}_${group} ${file})
  endforeach()
  if(folder STREQUAL ros)
    target_link_libraries(${target} PRIVATE codesign_ros)
  elseif(folder STREQUAL mpi)
    target_link_libraries(${target} PRIVATE codesign_mpi)
    add_dependencies(${target} codesign)
  elseif(folder STREQUAL cli AND TARGET codesign)
    target_link_libraries(${target} PRIVATE codesign_cli)
    add_dependencies(${target} codesign)
  endif()
  # The reference for robots without loops; without it the comparison is skipped.
  if(folder STREQUAL integration AND orocos_kdl_FOUND)
    target_include_directories(${target} SYSTEM PRIVATE ${orocos_kdl_INCLUDE_DIRS})
    target_link_libraries(${target} PRIVATE ${orocos_kdl_LIBRARIES} urdfdom::urdfdom_model)
    target_compile_definitions(${target} PRIVATE CODESIGN_HAS_KDL)
  endif()
  if(folder STREQUAL benchmark)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/benchmark/table.cc ${PROJECT_SOURCE_DIR}/benchmark/robots.cc
      ${PROJECT_SOURCE_DIR}/benchmark/articulated_body.cc ${PROJECT_SOURCE_DIR}/benchmark/derived_kernels.cc)
  endif()
  # catkin's choice, the devel space, is where rosrun looks for programs.
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/test)
  codesign_warnings(${target})
  if(CODESIGN_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM codesign_test_fixtures)
  endif()
  add_dependencies(tests ${target})
  if(folder IN_LIST many_cases)
    codesign_add_test(${folder} ${target} 6 1500)
  else()
    codesign_add_test(${folder} ${target} 1 1500)
  endif()
endforeach()

# What several threads do at once, compiled for the thread sanitizer with the tests themselves: tools/sanitize thread.
if(CODESIGN_SANITIZE MATCHES thread)
  set(thread_tests equations/equation_variant integration/simulation description/expression reading/urdf/urdfdom_check ros/common/worker sensitivity/threads
    engine/evaluation_engine engine/mpi_engine engine/dispatcher)
  list(TRANSFORM thread_tests REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/test/\\1_test.cc")
  add_executable(test_threads EXCLUDE_FROM_ALL ${thread_tests} ${PROJECT_SOURCE_DIR}/src/ros/common/worker.cc ${fixtures})
  target_include_directories(test_threads PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/test ${PROJECT_SOURCE_DIR}/include)
  target_link_libraries(test_threads PRIVATE codesign_core codesign_test_paths GTest::gtest GTest::gtest_main console_bridge::console_bridge)
  codesign_warnings(test_threads)
  codesign_sanitize(test_threads)
  set_target_properties(test_threads PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/test)
  codesign_add_test(threads test_threads 4 1500)
endif()

include(${PROJECT_SOURCE_DIR}/cmake/Fuzz.cmake)

add_test(NAME layering_of_objects COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/layering/check_symbols.py ${PROJECT_BINARY_DIR}/src/CMakeFiles/codesign_core.dir
  ${PROJECT_BINARY_DIR}/src/CMakeFiles/codesign_steps.dir)
add_test(NAME layering COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/layering/check_layering.py ${PROJECT_SOURCE_DIR})
add_test(NAME layering_self_test COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/layering/check_layering_test.py)

if(TARGET codesign_python)
  add_dependencies(tests codesign_python)
  foreach(part package problem loops observers jobs recordings interruption notebook tutorial features)
    add_test(NAME python_${part} COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/python/${part}_test.py)
    set_tests_properties(python_${part} PROPERTIES
      ENVIRONMENT "PYTHONPATH=${CATKIN_DEVEL_PREFIX}/lib/python3/dist-packages;CODESIGN=$<TARGET_FILE:codesign>")
  endforeach()
endif()

add_test(NAME update_tables COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/benchmark/update_tables_test.py)
add_test(NAME peers COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/benchmark/peers_test.py)
add_test(NAME corpus_table COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/corpus_table_test.py $<TARGET_FILE:codesign>)
add_test(NAME identify_cases COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/identify_cases_test.py $<TARGET_FILE:codesign>)
add_test(NAME features COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/features_test.py $<TARGET_FILE:codesign>)
# Forty of the random hybrid studies; --studies 200 compares all. doc/testing.md
add_test(NAME hybrid COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/hybrid/hybrid_test.py $<TARGET_FILE:codesign>)
add_test(NAME hybrid_solver COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/hybrid/event_solver_test.py)
# Motions whose objective has a formula, several ways each. doc/events.md
add_test(NAME closed_forms COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/hybrid/closed_forms_test.py $<TARGET_FILE:codesign>)
add_test(NAME json_schema COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/json_schema_test.py $<TARGET_FILE:codesign>)
add_test(NAME pages COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/pages_test.py)
add_test(NAME readme COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/readme_test.py $<TARGET_FILE:codesign>)
add_test(NAME gallery COMMAND ${PYTHON_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/test/scripts/gallery_test.py $<TARGET_FILE:codesign>)
add_test(NAME watch_page COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/watch_test.py)
add_test(NAME report COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/report_test.py $<TARGET_FILE:codesign>)
add_test(NAME linear_report COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/linear_report_test.py $<TARGET_FILE:codesign>)
add_test(NAME tradeoff_report COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/tradeoff_report_test.py)
add_test(NAME report_parts COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/report_parts_test.py)
set(codesign_setup)
set(codesign_reads_bags)
if(TARGET codesign_ros)
  set(codesign_setup ${CATKIN_DEVEL_PREFIX}/setup.bash)
  set(codesign_reads_bags --ros)
endif()
add_test(NAME tutorial_pages COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/tutorial_pages_test.py $<TARGET_FILE:codesign> ${codesign_reads_bags})
add_test(NAME command_line COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/command_line_test.py $<TARGET_FILE:codesign>
  ${PROJECT_BINARY_DIR}/share/man/man1/codesign.1 ${codesign_setup})
add_test(NAME compare_algorithms COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/compare_algorithms_test.py $<TARGET_FILE:codesign>)
add_test(NAME identify_then_tune COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/identify_then_tune_test.py $<TARGET_FILE:codesign>)

if(MPI_C_FOUND)
  add_test(NAME two_hosts COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/mpi/two_hosts_test.py $<TARGET_FILE:codesign> ${MPIEXEC_EXECUTABLE})
  # The network of the hosts is theirs, the processors are not.
  set_tests_properties(two_hosts PROPERTIES TIMEOUT 1200)
endif()

# What doc/api.md prints builds outside the project. The configuration is where catkin, or WithoutRos.cmake, writes it.
if(TARGET codesign_ros)
  set(codesign_api_place ${CATKIN_DEVEL_PREFIX}/share/${PROJECT_NAME}/cmake $<TARGET_FILE:codesign> ${PROJECT_BINARY_DIR} --catkin)
else()
  set(codesign_api_place ${PROJECT_BINARY_DIR} $<TARGET_FILE:codesign> ${PROJECT_BINARY_DIR})
endif()
add_test(NAME api_page COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/api/api_page_test.py ${PROJECT_SOURCE_DIR} ${codesign_api_place})

foreach(tool build check ci clone debian_packages doc fresh image measured_data packages run_tests)
  add_test(NAME tools_${tool} COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/tools/${tool}_test.py)
endforeach()
# Skipped, with a message, where there is no sphinx; without chromium the pages are built, but not looked at.
set_tests_properties(tools_doc PROPERTIES SKIP_REGULAR_EXPRESSION "no sphinx on this machine")

if(TARGET codesign_ros)
  add_test(NAME launch_files COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/ros/launch_files_test.py ${PROJECT_SOURCE_DIR})
  add_test(NAME trajectory_from_bag COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/trajectory_from_bag_test.py)
  add_test(NAME example_controller COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/example_controller_test.py)
  add_test(NAME panel COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/panel_test.py)
  # Skipped, with a message, where there is no chromium.
  add_test(NAME panel_page COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/panel_page_test.py)
  set_tests_properties(panel_page PROPERTIES SKIP_REGULAR_EXPRESSION "no chromium on this machine")
  add_test(NAME figures COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/figures_test.py)
  add_test(NAME show_in_rviz COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/scripts/show_in_rviz_test.py)

  find_package(rostest REQUIRED)
  file(GLOB rostests RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/ros/*.test)
  foreach(file IN LISTS rostests)
    add_rostest(${file} DEPENDENCIES ${codesign_nodes})
  endforeach()
endif()

include(${PROJECT_SOURCE_DIR}/cmake/TestLabels.cmake)
