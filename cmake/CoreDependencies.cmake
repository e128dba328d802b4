# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# The dependencies of the core, without ROS.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
include(cmake/Sundials.cmake)
find_package(NLopt REQUIRED)
find_package(urdfdom_headers REQUIRED)
find_package(urdfdom REQUIRED)
find_package(tinyxml2 REQUIRED)
find_package(console_bridge REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Threads REQUIRED)

# Creates an INTERFACE target codesign_<name> for libraries (ARGN) without a CMake configuration.
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

codesign_import(klu klu.h suitesparse klu amd colamd btf suitesparseconfig)
codesign_import(spqr SuiteSparseQR.hpp suitesparse spqr cholmod)
# Headers alone: Boost's libraries are not linked.
codesign_import(boost boost/random/sobol.hpp "")

# Xbyak compiles equations and sparse factorizations to machine code on x86-64. Without it, templates and loops are used instead.
find_path(XBYAK_INCLUDE_DIR xbyak/xbyak.h)
mark_as_advanced(XBYAK_INCLUDE_DIR)
add_library(codesign_xbyak INTERFACE IMPORTED)
if(CODESIGN_MACHINE_CODE AND XBYAK_INCLUDE_DIR AND CMAKE_SYSTEM_PROCESSOR STREQUAL x86_64)
  target_include_directories(codesign_xbyak SYSTEM INTERFACE ${XBYAK_INCLUDE_DIR})
  target_compile_definitions(codesign_xbyak INTERFACE CODESIGN_MACHINE_CODE)
endif()
