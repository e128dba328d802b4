// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/event.h"

namespace codesign {

std::string describe(const Event& event) {
  return event.element + ", \"" + event.expression + "\", " +
         (event.rising ? "rising" : "falling") + (event.jump ? ", a jump" : ", a kink");
}

}  // namespace codesign
