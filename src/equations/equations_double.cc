// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/equations_scalar.h"

namespace codesign {

CODESIGN_INSTANTIATE_EQUATIONS(double)
template void Equations<double>::assemble(PatternRecorder*);

}  // namespace codesign
