# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# The Python package mechanism_codesign: `import mechanism_codesign as codesign`. With ROS it also has the generated messages, which catkin writes
# into its folder in the devel space. As catkin's own packages of sources and generated modules, it is a relay there: sources stay where they are.

set(codesign_python_destination lib/python3/dist-packages/${PROJECT_NAME})
set(codesign_python_paths ${PROJECT_SOURCE_DIR}/python/${PROJECT_NAME} ${PROJECT_SOURCE_DIR}/scripts ${PROJECT_BINARY_DIR}/python)
configure_file(python/relay.py.in ${CATKIN_DEVEL_PREFIX}/${codesign_python_destination}/__init__.py @ONLY)
install(DIRECTORY python/${PROJECT_NAME}/ DESTINATION ${codesign_python_destination} PATTERN "__pycache__" EXCLUDE)
# The page of `codesign report`, one copy for both. Generated messages are installed with the compiled relay of the devel space.
file(RELATIVE_PATH codesign_report_from_python /${codesign_python_destination} /${CATKIN_PACKAGE_SHARE_DESTINATION}/scripts/codesign_report)
install(CODE "
  set(package \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${codesign_python_destination}\")
  file(REMOVE_RECURSE \${package}/__pycache__)
  file(CREATE_LINK ${codesign_report_from_python} \${package}/codesign_report SYMBOLIC)")

# For the Python of Python3_EXECUTABLE (cmake/Environment.cmake).
set(PYBIND11_FINDPYTHON ON)
# By the name Python, which pybind11 prefers once anything has found an interpreter by that name.
set(Python_EXECUTABLE ${Python3_EXECUTABLE})
find_package(Python QUIET COMPONENTS Interpreter Development.Module)
if(Python_Development.Module_FOUND)
  find_package(pybind11 2.10 QUIET)
endif()
# A sanitizer watches whole programs, and Python is not ours.
if(CODESIGN_SANITIZE)
  return()
endif()
if(NOT pybind11_FOUND)
  message(STATUS "No pybind11: the extension of the Python package is left out (pybind11-dev, python3-dev)")
  return()
endif()
file(GLOB python_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/python/*.cc)
if(TARGET codesign_ros)
  set(python_bag_files ${PROJECT_SOURCE_DIR}/src/ros/loaded_bag_files.cc)
else()
  set(python_bag_files ${PROJECT_SOURCE_DIR}/src/cli/no_bag_files.cc)
endif()
pybind11_add_module(codesign_python MODULE NO_EXTRAS ${python_sources} ${python_bag_files})
target_include_directories(codesign_python PRIVATE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
target_link_libraries(codesign_python PRIVATE codesign_core nlohmann_json::nlohmann_json ${CMAKE_DL_LIBS})
codesign_warnings(codesign_python)
codesign_optimize_little(codesign_python)
codesign_unite(codesign_python python ${python_sources} ${python_bag_files})
if(TARGET codesign_ros)
  add_dependencies(codesign_python codesign_bag_module)
endif()
# From the extension to the libraries; bags are loaded by name.
file(RELATIVE_PATH codesign_libraries_from_python /${codesign_python_destination} /${CATKIN_PACKAGE_LIB_DESTINATION})
set_target_properties(codesign_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/python
  INSTALL_RPATH "$ORIGIN/${codesign_libraries_from_python}")
install(TARGETS codesign_python LIBRARY DESTINATION ${codesign_python_destination})
