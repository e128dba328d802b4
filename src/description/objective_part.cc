// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/objective_part.h"

#include "description/motion_study.h"

namespace codesign {

std::string term_name(const MotionStudy& study, ObjectivePart part, std::size_t term) {
  const char* list = part == ObjectivePart::kTerminal ? "terminal"
                     : study.postures > 0             ? "sum"
                                                      : "integral";
  return std::string("objective.") + list + "[" + std::to_string(term) + "]";
}

}  // namespace codesign
