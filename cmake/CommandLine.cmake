# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# What a user of the program codesign meets in a shell: PATH, completion, the manual page, and the script behind `codesign report`; in the devel
# space and in an installation. A shell that sources setup.bash has the `bin` of an installation in PATH, of a build one in the build folder, and man
# finds `share/man` beside it.

if(NOT TARGET codesign)
  return()
endif()

set(codesign_share ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_SHARE_DESTINATION})
# The manual page has commands and options from the program's own help.
set(codesign_manual ${PROJECT_BINARY_DIR}/share/man/man1/codesign.1)
set(commands "@commands@")
configure_file(man/codesign.1.in ${PROJECT_BINARY_DIR}/codesign.1.in @ONLY)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share/man/man1)
add_custom_command(OUTPUT ${codesign_manual}
  COMMAND ${PROJECT_SOURCE_DIR}/man/write_manual $<TARGET_FILE:codesign> ${PROJECT_BINARY_DIR}/codesign.1.in > ${codesign_manual}
  DEPENDS codesign man/write_manual ${PROJECT_BINARY_DIR}/codesign.1.in VERBATIM)
add_custom_target(codesign_manual_page ALL DEPENDS ${codesign_manual})
install(FILES ${codesign_manual} DESTINATION share/man/man1)
foreach(shell bash zsh)
  configure_file(completion/codesign.${shell} ${codesign_share}/completion/codesign.${shell} COPYONLY)
endforeach()
install(DIRECTORY completion DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})

# In the devel space scripts stay where they are: rosrun would otherwise find them twice.
file(WRITE ${codesign_share}/scripts.path "${PROJECT_SOURCE_DIR}/scripts\n")
install(PROGRAMS scripts/report DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/scripts)
install(DIRECTORY scripts/codesign_report DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/scripts PATTERN "__pycache__" EXCLUDE)

if(NOT catkin_FOUND)
  return()
endif()
# A package of Debian puts the completion where every shell looks.
if(NOT CATKIN_BUILD_BINARY_PACKAGE)
  catkin_add_env_hooks(50.codesign SHELLS bash zsh DIRECTORY ${PROJECT_SOURCE_DIR}/env-hooks)
endif()
catkin_add_env_hooks(40.codesign_path SHELLS sh DIRECTORY ${PROJECT_SOURCE_DIR}/env-hooks SKIP_INSTALL)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
file(CREATE_LINK ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION}/codesign ${PROJECT_BINARY_DIR}/bin/codesign SYMBOLIC)
install(CODE "
  set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CATKIN_GLOBAL_BIN_DESTINATION}\")
  file(MAKE_DIRECTORY \${folder})
  file(CREATE_LINK ../${CATKIN_PACKAGE_BIN_DESTINATION}/codesign \${folder}/codesign SYMBOLIC)")
