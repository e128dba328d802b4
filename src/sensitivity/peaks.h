// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "integration/watch_layout.h"
#include "mechanism_codesign/gradient.h"

namespace codesign {

/// The value of a watched signal of greatest magnitude: its place among the numbers, and its sign.
struct Peak {
  int place = 0;
  double sign = 1.0;
};
Peak find_peak(const WatchLayout::Entry& entry, const Eigen::VectorXd& values);

/// The peaks in the objective, sum of weight max |signal - reference|, theory (21a); 0 without peaks. @param gradient if not null, their
/// gradient is added to it. @param layout of the study.
double peak_terms(const Study& study, const WatchLayout& layout, const Extremes& extremes, Eigen::VectorXd* gradient);
double peak_terms(const Study& study, const Extremes& extremes, Eigen::VectorXd* gradient);

}  // namespace codesign
