// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/traced.h"
#include "equations/formulas_loop.h"

namespace codesign {

template class Formulas<Traced>;

}  // namespace codesign
