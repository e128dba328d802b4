// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_IDAS_STATUS_H_
#define MECHANISM_CODESIGN_INTEGRATION_IDAS_STATUS_H_

#include <string>

#include "mechanism_codesign/status.h"

namespace codesign {

/// Our status for a flag of IDASolve.
/// @param time [s] that was reached. @param singular whether the last Newton matrix was. @param message IDAS's own, or of an exception in a
/// callback.
Status idas_status(int flag, double time, bool singular, const std::string& message);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_IDAS_STATUS_H_
