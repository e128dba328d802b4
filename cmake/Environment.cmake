# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# Settings that must be made before catkin is found.

# The Python modules of ROS are installed for the system interpreter. catkin reads PYTHON_EXECUTABLE, rosbag (through pluginlib)
# Python3_EXECUTABLE; without these settings both take the first python3 in PATH.
set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python of the ROS installation")
set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python of the ROS installation")

# Outside a catkin workspace the package is its own workspace, with its devel space in <package>/devel, where rosrun and roslaunch find it.
if(NOT DEFINED CATKIN_DEVEL_PREFIX)
  set(CATKIN_DEVEL_PREFIX ${PROJECT_SOURCE_DIR}/devel CACHE PATH "Where the package can be used from without being installed")
endif()

# catkin fixes the environment of its tests at the first configuration and leaves out directories that do not exist then.
file(MAKE_DIRECTORY ${CATKIN_DEVEL_PREFIX}/lib/python3/dist-packages)

# The default of catkin, set here because catkin is found only after the core has been declared.
option(BUILD_SHARED_LIBS "Build shared libraries" ON)

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
