# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# Labels of the tests, beside `unit`, which cmake/Tests.cmake sets: what tools/test and tools/ci select by.

# What tools/test --quick leaves out: whole jobs, processes of MPI, builds of other programs, a browser, and what starts a ROS master.
set(codesign_label_slow "^(mpi\\.|cases\\.|allocation\\.|fuzz|two_hosts|identify_|compare_algorithms|command_line|json_schema|features|gallery|hybrid$|closed_forms$|tutorial_pages|report$|python_(jobs|interruption|tutorial|features)|corpus_table|api_page|tools_doc|panel_page|trajectory_from_bag|_ctest_.*rostest)")
# What takes a processor for less than half of its time: tools/run_tests runs eight of them at once.
set(codesign_label_waits "^(_ctest_.*rostest|panel$|panel_page|two_hosts|mpi\\.|engine\\.)")
# What depends on the Python, the ROS and the CMake of the system: tools/test --release.
set(codesign_label_release "^(python_|report|readme|command_line|api_page|launch_files|trajectory_from_bag|example_controller|panel$|figures|show_in_rviz|_ctest_.*rostest)")
get_property(codesign_tests DIRECTORY PROPERTY TESTS)
foreach(label slow waits release)
  foreach(test IN LISTS codesign_tests)
    if(test MATCHES "${codesign_label_${label}}")
      set_property(TEST ${test} APPEND PROPERTY LABELS ${label})
    endif()
  endforeach()
endforeach()
