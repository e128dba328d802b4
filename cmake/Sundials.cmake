# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# SUNDIALS 6 or 7. Its configuration admits one major version at a time, so the version is checked here.

find_package(SUNDIALS REQUIRED CONFIG)
if(SUNDIALS_VERSION VERSION_LESS 6 OR SUNDIALS_VERSION VERSION_GREATER_EQUAL 8)
  message(FATAL_ERROR "SUNDIALS ${SUNDIALS_VERSION} in ${SUNDIALS_DIR}: versions 6 and 7 are supported")
endif()
