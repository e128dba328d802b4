// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <deque>
#include <string>

#include "mechanism_codesign/event.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// Sees where designs beside the best one have other events than it, or the same ones in another
/// order: there the objective can have a kink or a jump. It keeps the last trial points of a search
/// with one scenario.
class EventChanges {
 public:
  /// A trial point whose run has succeeded. @param rho the tuned parameters.
  void note(const Eigen::VectorXd& rho, const Events& events);
  /// The warning `events_changed`, if a kept point differs from the best one by at most a
  /// thousandth of the range of each parameter and has other events.
  /// @param ranges of the parameters, all positive. @param file of the study.
  Warnings warnings(const Eigen::VectorXd& best, const Events& of_best,
                    const Eigen::VectorXd& ranges, const std::string& file) const;

 private:
  static constexpr std::size_t kKept = 500;

  struct Neighbour {
    Eigen::VectorXd rho;
    std::int64_t count = 0;
    std::string order;
  };
  std::deque<Neighbour> last_;
};

}  // namespace codesign
