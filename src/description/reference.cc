// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "math/arrays.h"

namespace codesign {
namespace {

/// Knot i [s]; the first and the last knot are repeated.
double knot(const BasisDescription& basis, int i) {
  const int spans = basis.count() - basis.degree();
  return basis.duration * std::clamp(i - basis.degree(), 0, spans) / spans;
}

/// The degree + 1 B-splines of `degree` that are not zero on the knot span `span`, at t, by de
/// Boor's recurrence.
void spline_values(const BasisDescription& basis, int span, int degree, double t,
                   Out<double> values) {
  values[0] = 1.0;
  for (int d = 1; d <= degree; ++d) {
    double carried = 0.0;
    for (int r = 0; r < d; ++r) {
      const double right = knot(basis, span + r + 1), left = knot(basis, span + 1 - d + r);
      const double share = values[r] / (right - left);
      values[r] = carried + (right - t) * share;
      carried = (t - left) * share;
    }
    values[d] = carried;
  }
}

using Found = std::set<int>;

void add(const Quantity& quantity, Found* found) {
  if (quantity.is_constant()) return;
  const std::vector<int>& used = quantity.expression()->dependencies();
  found->insert(used.begin(), used.end());
}

void add(const std::vector<Quantity>& quantities, Found* found) {
  for (const Quantity& quantity : quantities) add(quantity, found);
}

void add(const ReferenceDescription& description, Found* found) {
  switch (description.kind) {
    case ReferenceDescription::Kind::kConstant:
      add(description.constant, found);
      break;
    case ReferenceDescription::Kind::kSine: {
      const SineDescription& sine = description.sine;
      add({sine.amplitude, sine.phase, sine.offset, sine.frequency}, found);
      break;
    }
    case ReferenceDescription::Kind::kWaypoints:
      add(description.waypoints.positions, found);
      add(description.waypoints.velocities, found);
      add(description.waypoints.accelerations, found);
      break;
    case ReferenceDescription::Kind::kSampled:
      add({description.sampled.scale, description.sampled.delay, description.sampled.offset},
          found);
      break;
    case ReferenceDescription::Kind::kLive:
      add(*description.live.planned, found);
      break;
    case ReferenceDescription::Kind::kIntegral:
      add(*description.integral.rate, found);
      add(description.integral.start, found);
      break;
    case ReferenceDescription::Kind::kExpression:
      for (const int used : description.expression.formula->dependencies())
        if (used != description.expression.time) found->insert(used);
      break;
  }
}

}  // namespace

std::array<double, 2> BasisDescription::support(int k) const {
  const double end =
      k == count() - 1 ? std::numeric_limits<double>::infinity() : knot(*this, k + degree() + 1);
  return {knot(*this, k), end};
}

BasisWeights basis_weights(const BasisDescription& basis, double t) {
  const int degree = basis.degree(), spans = basis.count() - degree;
  const double inside = std::clamp(t, 0.0, basis.duration);
  BasisWeights weights;
  weights.first =
      std::clamp(static_cast<int>(std::floor(inside / basis.duration * spans)), 0, spans - 1);
  weights.count = degree + 1;
  const int span = weights.first + degree;
  spline_values(basis, span, degree, inside, weights.value);
  if (t > basis.duration) return weights;
  // B_k' = p (b_k / (t_(k+p) - t_k) - b_(k+1) / (t_(k+p+1) - t_(k+1))) with b_k of degree p - 1.
  double lower[4];
  spline_values(basis, span, degree - 1, inside, lower);
  for (int r = 0; r < degree; ++r) {
    const double share =
        degree * lower[r] / (knot(basis, span + r + 1) - knot(basis, span + r + 1 - degree));
    weights.rate[to_index(r)] -= share;
    weights.rate[to_index(r) + 1] += share;
  }
  return weights;
}

const ReferenceDescription& clock_function() {
  static const ReferenceDescription kClock = [] {
    ReferenceDescription clock;
    clock.kind = ReferenceDescription::Kind::kExpression;
    clock.expression = {std::make_shared<const Expression>("t", std::vector<std::string>{"t"}), 0};
    return clock;
  }();
  return kClock;
}

std::vector<int> dependencies(const ReferenceDescription& description) {
  Found found;
  add(description, &found);
  return {found.begin(), found.end()};
}

std::vector<int> dependencies(const BasisDescription& description) {
  Found found;
  add(description.coefficients, &found);
  return {found.begin(), found.end()};
}

}  // namespace codesign
