# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# Puts programs where rosrun finds them and libraries where other packages find them, in the devel space and in an installation.

# Relative path from the programs to the libraries, for their RPATH.
file(RELATIVE_PATH codesign_libraries_from_programs /${CATKIN_PACKAGE_BIN_DESTINATION} /${CATKIN_PACKAGE_LIB_DESTINATION})

set(codesign_programs ${codesign_nodes})
if(TARGET codesign)
  list(APPEND codesign_programs codesign)
endif()
if(codesign_programs)
  set_target_properties(${codesign_programs} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION}
    INSTALL_RPATH "$ORIGIN/${codesign_libraries_from_programs}")
  install(TARGETS ${codesign_programs} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endif()
set(codesign_libraries codesign_core)
if(TARGET codesign_ros)
  list(APPEND codesign_libraries codesign_ros codesign_bag_module)
endif()
set_target_properties(${codesign_libraries} PROPERTIES
  ARCHIVE_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_LIB_DESTINATION}
  INSTALL_RPATH "$ORIGIN")
set(library_destinations
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
# Others link the target mechanism_codesign::codesign_core. The library behind the nodes is not for others.
install(TARGETS codesign_core EXPORT mechanism_codesignTargets ${library_destinations})
if(TARGET codesign_ros)
  install(TARGETS codesign_ros codesign_bag_module ${library_destinations})
endif()
install(EXPORT mechanism_codesignTargets NAMESPACE mechanism_codesign:: DESTINATION ${codesign_config_destination})
export(EXPORT mechanism_codesignTargets NAMESPACE mechanism_codesign:: FILE ${PROJECT_BINARY_DIR}/mechanism_codesignTargets.cmake)
install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY config gallery tour urdf DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
