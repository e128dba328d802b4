// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace codesign {

/// The shortest text that reads back as the same double, independent of the locale: `0.07`, `1e-06`, `inf`, `nan`.
std::string to_decimal(double value);

}  // namespace codesign
