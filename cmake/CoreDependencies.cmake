# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# What the core is built on; none of it is ROS.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(SUNDIALS 6 REQUIRED CONFIG)
find_package(NLopt REQUIRED)
find_package(urdfdom_headers REQUIRED)
find_package(urdfdom REQUIRED)
find_package(tinyxml2 REQUIRED)
find_package(console_bridge REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Threads REQUIRED)

# An INTERFACE target for a library that brings no CMake configuration.
function(codesign_import name header header_suffixes)
  string(TOUPPER ${name} prefix)
  find_path(${prefix}_INCLUDE_DIR ${header} PATH_SUFFIXES ${header_suffixes} REQUIRED)
  mark_as_advanced(${prefix}_INCLUDE_DIR)
  set(libraries)
  foreach(library IN LISTS ARGN)
    string(TOUPPER ${library}_LIBRARY variable)
    find_library(${variable} ${library} REQUIRED)
    mark_as_advanced(${variable})
    list(APPEND libraries ${${variable}})
  endforeach()
  add_library(codesign_${name} INTERFACE IMPORTED)
  target_include_directories(codesign_${name} SYSTEM INTERFACE ${${prefix}_INCLUDE_DIR})
  target_link_libraries(codesign_${name} INTERFACE ${libraries})
endfunction()

codesign_import(muparserx mpParser.h muparserx muparserx)
codesign_import(klu klu.h suitesparse klu amd colamd btf suitesparseconfig)
# Only the header-only dual numbers of Ceres.
codesign_import(ceres_jet ceres/jet.h "")
