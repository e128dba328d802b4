// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/bag_files.h"

namespace codesign {

BagFiles bag_files() { return {}; }

}  // namespace codesign
