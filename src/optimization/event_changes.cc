// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/event_changes.h"

#include <limits>

#include "text/number_text.h"

namespace codesign {

void EventChanges::note(const Eigen::VectorXd& rho, const Events& events) {
  last_.push_back({rho, events.count, events.order});
  if (last_.size() > kKept) last_.pop_front();
}

Warnings EventChanges::warnings(const Eigen::VectorXd& best, const Events& of_best,
                                const Eigen::VectorXd& ranges, const std::string& file) const {
  constexpr double kNear = 1e-3;
  double nearest = std::numeric_limits<double>::infinity();
  const Neighbour* other = nullptr;
  for (const Neighbour& one : last_) {
    if (one.count == of_best.count && one.order == of_best.order) continue;
    const double distance = ((one.rho - best).array() / ranges.array()).abs().maxCoeff();
    if (distance >= nearest) continue;
    nearest = distance;
    other = &one;
  }
  if (!(nearest <= kNear)) return {};
  const std::string difference =
      other->count == of_best.count
          ? std::to_string(of_best.count) + " events in another order"
          : std::to_string(other->count) + " events in place of " + std::to_string(of_best.count);
  return {warn("events_changed",
               {{file, 0},
                "search",
                "the run of a design beside the best one has " + difference +
                    ": the objective can have a kink or a jump between them, where a slope of zero "
                    "says nothing of an optimum",
                readable(nearest, 2) + " of the parameters' ranges away",
                "the same events in the same order"})};
}

}  // namespace codesign
