# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# Messages, the library of the nodes, the nodes, and the installation of scripts and launch files.

set(message_dependencies actionlib_msgs std_msgs)
set(ros_dependencies
  actionlib diagnostic_updater dynamic_reconfigure geometry_msgs rosbag roscpp rosgraph_msgs sensor_msgs std_srvs tf2_msgs tf2_ros trajectory_msgs visualization_msgs xmlrpcpp ${message_dependencies})
find_package(catkin REQUIRED COMPONENTS message_generation ${ros_dependencies})
# What reading a bag takes: much less than roscpp.
set(bag_libraries)
foreach(package rosbag_storage roscpp_serialization rostime cpp_common)
  find_package(${package} REQUIRED)
  list(APPEND bag_libraries ${${package}_LIBRARIES})
endforeach()

file(GLOB message_files RELATIVE ${PROJECT_SOURCE_DIR}/msg CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/msg/*.msg)
file(GLOB service_files RELATIVE ${PROJECT_SOURCE_DIR}/srv CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/srv/*.srv)
file(GLOB action_files RELATIVE ${PROJECT_SOURCE_DIR}/action CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/action/*.action)
add_message_files(DIRECTORY msg FILES ${message_files})
add_service_files(DIRECTORY srv FILES ${service_files})
add_action_files(DIRECTORY action FILES ${action_files})
# The package of the messages has sources, too (cmake/Python.cmake): their __init__.py is not generated.
set(${PROJECT_NAME}_CATKIN_PYTHON_SETUP_HAS_PACKAGE_INIT TRUE)
generate_messages(DEPENDENCIES ${message_dependencies})

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES codesign_core
  # Only the dependencies of the messages: the library needs no ROS, and the library of the nodes is not exported.
  CATKIN_DEPENDS message_runtime ${message_dependencies}
  DEPENDS EIGEN3
  CFG_EXTRAS mechanism_codesign-targets.cmake)

# catkin's configuration finds messages with all their packages, which a program that links the library alone does not need, and looks for
# the library in the prefix for which this project is configured. So our configuration has its name, and includes it for catkin packages.
foreach(space ${CATKIN_DEVEL_PREFIX}/share/${PROJECT_NAME}/cmake ${PROJECT_BINARY_DIR}/catkin_generated/installspace)
  file(RENAME ${space}/mechanism_codesignConfig.cmake ${space}/mechanism_codesign-catkin.cmake)
  configure_file(cmake/mechanism_codesignConfig.cmake.in ${space}/mechanism_codesignConfig.cmake COPYONLY)
endforeach()
# For the prefix /usr, Debian's catkin puts the configuration beside the libraries of the architecture.
set(codesign_config_destination ${CATKIN_PACKAGE_SHARE_DESTINATION}/cmake)
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr" AND CMAKE_LIBRARY_ARCHITECTURE)
  set(codesign_config_destination ${CATKIN_GLOBAL_LIB_DESTINATION}/cmake/${PROJECT_NAME})
endif()
install(FILES ${PROJECT_BINARY_DIR}/catkin_generated/installspace/mechanism_codesign-catkin.cmake DESTINATION ${codesign_config_destination})

# What decompresses the chunks of a bag; development packages of rosbag_storage bring both.
find_package(BZip2 REQUIRED)
find_library(CODESIGN_LZ4 lz4 REQUIRED)
list(APPEND bag_libraries ${BZIP2_LIBRARIES} ${CODESIGN_LZ4})

# Reads recordings from bags and writes runs, identifications and trajectories into them, for the nodes and for the program codesign, which
# uses nothing else of ROS.
file(GLOB bag_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/ros/scene/*.cc ${PROJECT_SOURCE_DIR}/src/ros/bags/*.cc)
add_library(codesign_bags STATIC ${bag_sources})
add_dependencies(codesign_bags ${PROJECT_NAME}_generate_messages_cpp)
set_target_properties(codesign_bags PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_include_directories(codesign_bags PUBLIC ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
target_include_directories(codesign_bags SYSTEM PUBLIC ${CATKIN_DEVEL_PREFIX}/include ${catkin_INCLUDE_DIRS} ${rosbag_storage_INCLUDE_DIRS})
target_link_libraries(codesign_bags PUBLIC codesign_core ${bag_libraries})
codesign_warnings(codesign_bags)
codesign_optimize_little(codesign_bags)
codesign_unite(codesign_bags ros_bags ${bag_sources})
codesign_sanitize(codesign_bags)

# The program loads it when it first reads or writes a bag.
add_library(codesign_bag_module MODULE $<TARGET_OBJECTS:codesign_bags>)
set_target_properties(codesign_bag_module PROPERTIES OUTPUT_NAME codesign_bags LINKER_LANGUAGE CXX)
target_link_libraries(codesign_bag_module PRIVATE codesign_bags)
# CMake gives modules no name of their own, which Debian asks of every file among the libraries.
target_link_options(codesign_bag_module PRIVATE -Wl,-soname,libcodesign_bags.so)
codesign_sanitize(codesign_bag_module)
target_sources(codesign PRIVATE ${PROJECT_SOURCE_DIR}/src/ros/loaded_bag_files.cc)
target_link_libraries(codesign PRIVATE ${CMAKE_DL_LIBS})
add_dependencies(codesign codesign_bag_module)

file(GLOB ros_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/ros/common/*.cc ${PROJECT_SOURCE_DIR}/src/ros/apply/*.cc
  ${PROJECT_SOURCE_DIR}/src/ros/simulation/*.cc ${PROJECT_SOURCE_DIR}/src/ros/jobs/*.cc)
add_library(codesign_ros ${ros_sources})
add_dependencies(codesign_ros ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
target_include_directories(codesign_ros
  PUBLIC ${PROJECT_SOURCE_DIR}/include
  PRIVATE ${PROJECT_SOURCE_DIR}/src)
target_include_directories(codesign_ros SYSTEM PUBLIC ${CATKIN_DEVEL_PREFIX}/include ${catkin_INCLUDE_DIRS})
target_link_libraries(codesign_ros PUBLIC codesign_core codesign_bags ${catkin_LIBRARIES} PRIVATE yaml-cpp)
codesign_warnings(codesign_ros)
codesign_optimize_little(codesign_ros)
# Two units, so that an edit of one source compiles in less than 20 s; together they take a fifth longer than one would.
set(ros_requests ${ros_sources})
list(FILTER ros_requests INCLUDE REGEX "/src/ros/(apply|jobs)/")
list(REMOVE_ITEM ros_sources ${ros_requests})
codesign_unite(codesign_ros ros_runs ${ros_sources})
codesign_unite(codesign_ros ros_requests ${ros_requests})
codesign_sanitize(codesign_ros)
codesign_precompile_files(codesign_ros <ros/ros.h>)

# Each file becomes the executable of its name.
file(GLOB node_mains CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/ros/nodes/*.cc)
set(codesign_nodes)
foreach(node_main IN LISTS node_mains)
  get_filename_component(node ${node_main} NAME_WE)
  add_executable(${node} ${node_main})
  target_include_directories(${node} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${node} PRIVATE codesign_ros)
  codesign_warnings(${node})
  list(APPEND codesign_nodes ${node})
endforeach()

target_link_libraries(optimization PRIVATE codesign_mpi)

install(PROGRAMS scripts/bag_text scripts/case_figures scripts/example_client scripts/example_controller scripts/identify_then_tune scripts/launch_input scripts/model_mismatch scripts/panel scripts/play_bag scripts/restore_parameters scripts/simulate_sensors
  scripts/show_in_rviz scripts/trajectory_from_bag scripts/watch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/scripts)
install(DIRECTORY scripts/codesign_panel DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/scripts PATTERN "__pycache__" EXCLUDE)
install(FILES scripts/panel.html scripts/watch.html DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/scripts)
install(DIRECTORY launch plotjuggler rviz DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
