// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace codesign {

/// A JSON object that keeps its keys in the order in which they are set. Declared only: whoever reads or makes one includes jobs/json.h,
/// which takes seconds to compile.
using Json = nlohmann::ordered_json;

}  // namespace codesign
