// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "jobs/json.h"
#include "jobs/json_records.h"

namespace codesign::cli {

/// Writes to_text(object) and flushes.
inline void print(const Json& object, std::ostream& out) { out << to_text(object) << std::flush; }

}  // namespace codesign::cli
