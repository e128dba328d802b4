// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_PROGRESS_LINE_H_
#define MECHANISM_CODESIGN_CLI_PROGRESS_LINE_H_

#include <string>

#include "optimization/progress_meter.h"

namespace codesign::cli {

/// "screening: 12 of 400 points, 288 runs, 31.2 runs/s, about 5 min left".
std::string progress_line(const Progress& progress);

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_PROGRESS_LINE_H_
