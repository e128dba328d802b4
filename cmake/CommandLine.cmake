# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# What a user of the program codesign meets in a shell: PATH, completion, the manual page, and the script behind `codesign report`; in the devel
# space and in an installation. A shell that sources setup.bash has their `bin` in PATH, and man finds `share/man` beside it.

if(NOT TARGET codesign)
  return()
endif()

set(codesign_share ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_SHARE_DESTINATION})
configure_file(man/codesign.1.in ${CATKIN_DEVEL_PREFIX}/share/man/man1/codesign.1 @ONLY)
install(FILES ${CATKIN_DEVEL_PREFIX}/share/man/man1/codesign.1 DESTINATION share/man/man1)
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
catkin_add_env_hooks(50.codesign SHELLS bash zsh DIRECTORY ${PROJECT_SOURCE_DIR}/env-hooks)
set(codesign_link "../${CATKIN_PACKAGE_BIN_DESTINATION}/codesign")
file(MAKE_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_BIN_DESTINATION})
file(CREATE_LINK ${codesign_link} ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_BIN_DESTINATION}/codesign SYMBOLIC)
install(CODE "
  set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CATKIN_GLOBAL_BIN_DESTINATION}\")
  file(MAKE_DIRECTORY \${folder})
  file(CREATE_LINK ${codesign_link} \${folder}/codesign SYMBOLIC)")
