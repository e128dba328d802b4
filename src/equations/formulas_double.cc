// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/formulas_loop.h"

namespace codesign {

template class Formulas<double>;

}  // namespace codesign
