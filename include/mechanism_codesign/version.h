// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

/// The version of this package, such as "0.3.0": `<version>` of package.xml at the time of the
/// build. The text lives as long as the program.
const char* version();

}  // namespace codesign
