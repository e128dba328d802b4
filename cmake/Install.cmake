# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# Programs go where rosrun looks and libraries where other packages look, in the devel space and when installed.

set(codesign_programs ${codesign_nodes})
if(TARGET codesign)
  list(APPEND codesign_programs codesign)
endif()
if(codesign_programs)
  set_target_properties(${codesign_programs} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION}
    INSTALL_RPATH "$ORIGIN/..")
  install(TARGETS ${codesign_programs} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endif()
set_target_properties(codesign_core codesign_ros PROPERTIES
  ARCHIVE_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_LIB_DESTINATION}
  INSTALL_RPATH "$ORIGIN")
install(TARGETS codesign_core codesign_ros
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION} FILES_MATCHING PATTERN "*.h")
install(PROGRAMS scripts/bag_text scripts/case_figures scripts/model_mismatch scripts/trajectory_from_bag DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/scripts)
foreach(folder launch config urdf rviz)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${folder})
    install(DIRECTORY ${folder} DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
  endif()
endforeach()
