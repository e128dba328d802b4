// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/version.h"

namespace codesign {

const char* version() { return CODESIGN_VERSION; }

}  // namespace codesign
