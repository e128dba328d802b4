# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# The library that knows nothing of ROS, and its command line.

set(core_sources)
foreach(folder math model joints forces control dynamics integration sensitivity optimization)
  file(GLOB folder_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${folder}/*.cc)
  list(APPEND core_sources ${folder_sources})
endforeach()

add_library(codesign_core ${core_sources})
target_include_directories(codesign_core PUBLIC ${PROJECT_SOURCE_DIR}/include PRIVATE ${PROJECT_SOURCE_DIR}/src)
target_link_libraries(codesign_core
  PUBLIC Eigen3::Eigen Threads::Threads
  PRIVATE SUNDIALS::idas SUNDIALS::nvecserial SUNDIALS::sunlinsolklu codesign_klu NLopt::nlopt
    urdfdom::urdfdom_model tinyxml2::tinyxml2 console_bridge::console_bridge yaml-cpp codesign_muparserx)
codesign_warnings(codesign_core)
codesign_optimize(codesign_core)

# Everything of the command line but main(), so that tests can link it.
file(GLOB cli_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/cli/*.cc)
list(REMOVE_ITEM cli_sources ${PROJECT_SOURCE_DIR}/src/cli/main.cc)
if(cli_sources AND EXISTS ${PROJECT_SOURCE_DIR}/src/cli/main.cc)
  add_library(codesign_cli STATIC ${cli_sources})
  target_include_directories(codesign_cli PUBLIC ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(codesign_cli PUBLIC codesign_core nlohmann_json::nlohmann_json)
  codesign_warnings(codesign_cli)

  add_executable(codesign ${PROJECT_SOURCE_DIR}/src/cli/main.cc)
  target_link_libraries(codesign PRIVATE codesign_cli)
  codesign_warnings(codesign)
endif()
