// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_VERSION_H_
#define MECHANISM_CODESIGN_VERSION_H_

namespace codesign {

/// The version of this package, such as "0.1.0": `<version>` of package.xml at the time of the build. The text lives as long as the
/// program.
const char* version();

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_VERSION_H_
