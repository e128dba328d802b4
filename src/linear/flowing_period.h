// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>
#include <map>
#include <utility>
#include <vector>

#include "linear/state_space.h"

namespace codesign {

/// A loop of one input that flows between instants, theory (69b): x' = A x + B w, y = C x + D w,
/// and at instants of kind k x+ = J[k] x + G[k] w.
struct FlowingSpace {
  Eigen::MatrixXcd A, B, C;
  std::complex<double> D;
  std::vector<Eigen::MatrixXcd> J, G;
  std::vector<double> times;  ///< [s] from each instant to the next one
  std::vector<int> order;     ///< which k follow each other in a period

  double period() const;  ///< [s]
  /// From u to y, where w = u - y.
  FlowingSpace opened() const;
};
/// Combines elements in their order; a pair that occurs again is combined once.
/// @param then (element, what follows it) -> both.
template <class Element, class Then>
Element in_order(std::vector<Element> elements, std::vector<int> order, const Then& then) {
  while (order.size() > 1) {
    std::map<std::pair<int, int>, int> known;
    std::vector<int> shorter;
    for (std::size_t k = 0; k + 1 < order.size(); k += 2) {
      const auto pair =
          known.try_emplace({order[k], order[k + 1]}, static_cast<int>(elements.size()));
      if (pair.second)
        elements.push_back(then(elements[static_cast<std::size_t>(order[k])],
                                elements[static_cast<std::size_t>(order[k + 1])]));
      shorter.push_back(pair.first->second);
    }
    if (order.size() % 2 == 1) shorter.push_back(order.back());
    order = std::move(shorter);
  }
  return elements[static_cast<std::size_t>(order.front())];
}

/// The loop, and its derivatives along the direction of the space.
FlowingSpace values_of(const ComplexSpace& space);
FlowingSpace changes_of(const ComplexSpace& space);

/// The map of x over a period where w = (factor - 1) y: of the loop that is closed by factor
/// times its output.
Eigen::MatrixXcd map_with(const FlowingSpace& space, std::complex<double> factor);
/// Its derivative by the factor, and along a direction. @param change of the loop.
Eigen::MatrixXcd map_by_factor(const FlowingSpace& space, std::complex<double> factor);
Eigen::MatrixXcd map_along(const FlowingSpace& space, std::complex<double> factor,
                           const FlowingSpace& change);

/// The part of y that has the frequency [rad/s] of w = exp(j frequency t), long after the start.
std::complex<double> part_at(const FlowingSpace& space, double frequency);
/// Its derivative by the frequency, and along a direction.
std::complex<double> part_by_frequency(const FlowingSpace& space, double frequency);
std::complex<double> part_along(const FlowingSpace& space, double frequency,
                                const FlowingSpace& change);

/// The frequency [rad/s] of the largest of the sinusoids that y is made of in a motion with
/// x(period) = exp(j angle) x(0) of the loop closed by factor times its output; negative:
/// backwards.
double largest_sinusoid(const FlowingSpace& space, std::complex<double> factor,
                        const Eigen::VectorXcd& x, double angle);
/// The frequencies (angle + 2 pi m)/period [rad/s] next to those of the flow's own motions.
std::vector<double> frequencies_near(const Eigen::MatrixXcd& flow, double angle, double period);

}  // namespace codesign
