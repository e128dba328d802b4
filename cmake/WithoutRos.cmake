# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# Replaces the settings of catkin where it is not installed; doc/decisions/0029.

message(STATUS "No catkin: messages, nodes, launch files and their tests are left out; the library codesign_core, the program codesign and the core's tests are built")

target_sources(codesign PRIVATE ${PROJECT_SOURCE_DIR}/src/cli/no_bag_files.cc)
set(codesign_nodes)
include(GNUInstallDirs)
set(CATKIN_PACKAGE_BIN_DESTINATION ${CMAKE_INSTALL_BINDIR})
set(CATKIN_PACKAGE_LIB_DESTINATION ${CMAKE_INSTALL_LIBDIR})
set(CATKIN_GLOBAL_BIN_DESTINATION ${CMAKE_INSTALL_BINDIR})
set(CATKIN_PACKAGE_INCLUDE_DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${PROJECT_NAME})
set(CATKIN_PACKAGE_SHARE_DESTINATION ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME})

# catkin writes these files where it is there.
set(DEVELSPACE TRUE)
configure_file(cmake/mechanism_codesign-targets.cmake.in ${PROJECT_BINARY_DIR}/mechanism_codesignConfig.cmake @ONLY)
set(DEVELSPACE FALSE)
configure_file(cmake/mechanism_codesign-targets.cmake.in ${PROJECT_BINARY_DIR}/installed/mechanism_codesignConfig.cmake @ONLY)
set(codesign_config_destination ${CATKIN_PACKAGE_SHARE_DESTINATION}/cmake)
install(FILES ${PROJECT_BINARY_DIR}/installed/mechanism_codesignConfig.cmake DESTINATION ${codesign_config_destination})

option(CATKIN_ENABLE_TESTING "Build the tests" ON)
if(CATKIN_ENABLE_TESTING)
  find_package(GTest QUIET)
  if(GTest_FOUND)
    enable_testing()
    add_custom_target(tests)
  else()
    message(STATUS "No GoogleTest: the tests are left out")
    set(CATKIN_ENABLE_TESTING OFF)
  endif()
endif()
