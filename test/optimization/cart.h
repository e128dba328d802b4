// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mechanism_codesign/source_text.h"

namespace codesign {

/// A cart of 1 kg, the link `cart`, that slides along x without friction on the joint `slide`. The
/// parameter `mass` sets its mass.
SourceText cart_urdf();

}  // namespace codesign
