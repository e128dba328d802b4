// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The template of Assembly that the files of its parts share.
#pragma once

#include <algorithm>
#include <vector>

#include "assembly/assembly.h"

namespace codesign {

/// Continues the position work_.followed along a line, with steps that are halved where Newton's
/// method for the `free` coordinates does not converge at once, or to another solution than by way
/// of the middle of the step. Where the solution before is no start from which it converges, as
/// beside a position where several motions meet, the line through the last two solutions leads on.
/// @param step the first one, a part of the way. @param place_at (part of the way) -> the design
/// there. @param arrive called at the end of each step, where theta_ is the solution. @returns
/// whether the end was reached; else work_.followed is the last solution on the way and
/// work_.slope its change by the part of the way.
template <class PlaceAt, class Arrive>
bool Assembly::walk(const std::vector<int>& free, double step, const PlaceAt& place_at,
                    const Arrive& arrive, Equations<double>* equations) {
  constexpr double kShortest = 1.0 / 1024;
  // Between two solutions the one in the middle is off their mean by this part of their distance.
  constexpr double kBend = 0.25;
  const auto arrives = [&](double part) {
    const std::vector<double>& design = place_at(part);
    set_given_start(system_, tree_, design, posture_, &theta_, &theta_rate_);
    follow_couplings(*equations);
    return converges_at_once(design, free, equations);
  };
  double reached = 0.0;
  bool has_slope = false;
  const auto continues = [&](double next) {
    theta_ = work_.followed;
    if (!arrives(next)) return false;
    if (free.empty()) return true;
    work_.direct = theta_;
    theta_ = work_.followed;
    const bool same = arrives(0.5 * (reached + next)) && arrives(next) && is_same(work_.direct);
    theta_ = work_.direct;
    return same;
  };
  const auto leads_on = [&](double next) {
    const double part = next - reached;
    theta_ = work_.followed + part * work_.slope;
    if (!has_slope || !arrives(next)) return false;
    work_.direct = theta_;
    theta_ = work_.followed + 0.5 * part * work_.slope;
    if (!arrives(0.5 * (reached + next))) return false;
    theta_ = 2.0 * theta_ - work_.followed - work_.direct;
    const double bend = 0.5 * theta_.cwiseAbs().maxCoeff(),
                 moved = (work_.direct - work_.followed).cwiseAbs().maxCoeff();
    theta_ = work_.direct;
    place_at(next);
    return bend <= kBend * moved;
  };
  while (reached < 1.0 && step >= kShortest && !cancelled()) {
    const double next = std::min(1.0, reached + step);
    if (continues(next) || leads_on(next)) {
      work_.slope = (theta_ - work_.followed) / (next - reached);
      has_slope = true;
      work_.followed = theta_;
      arrive();
      reached = next;
      step *= 2.0;
    } else {
      step *= 0.5;
    }
  }
  if (!has_slope) work_.slope.setZero(tree_.size);
  return reached == 1.0;
}

}  // namespace codesign
