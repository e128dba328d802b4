// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mechanism_codesign/warning.h"

namespace codesign {

/// The first warning of each kind in each file, with the number of further places and the last of
/// them, in the order of the first ones. Of one kind are warnings of one code that differ only in
/// the place, in the names of elements and in the value. Warnings without a file stay.
/// @param warnings as warn() makes them.
Warnings told_once(const Warnings& warnings);

}  // namespace codesign
