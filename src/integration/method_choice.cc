// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/method_choice.h"

#include <algorithm>
#include <cmath>

#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {
namespace {

// Of the code DOPRI5: the limit of stability on the negative real axis, how many steps at it make a
// stiff stretch, and how many others in a row end the count.
constexpr double kLimit = 3.25;
constexpr int kStiffSteps = 15, kOtherSteps = 6;
// A margin against ping-pong, and against the error of the estimate.
constexpr double kCalm = 1.0;
constexpr int kLooks = 8, kFirstPause = 16, kLongestPause = 1024;

const RosenbrockTableau& first_method(const CompiledSystem& system) {
  const RosenbrockMethod method = system.study().solver.method;
  if (method != RosenbrockMethod::kAuto) return rosenbrock_tableau(method);
  if (system.compliance() > 0.0) return rodas4();
  return system.begins_explicitly() ? dopri5() : rodas5p();
}

/// h times an estimate of the largest |eigenvalue| of the equations from the last two stages of an
/// explicit pair, which both are at the end of the last attempt (Hairer and Wanner, Solving ODE II,
/// IV.2). The pair is stable up to 3.3.
double stiffness(const OneStep<double>& step, int states) {
  const std::size_t last = to_index(step.tableau().stages) - 1;
  const State<double>&at = step.stages()[last], &from = step.stages()[last - 1];
  const double rates =
      (step.increments()[last] - step.increments()[last - 1]).head(states).squaredNorm();
  const double change =
      (at.q - from.q).squaredNorm() + (at.v - from.v).squaredNorm() + (at.s - from.s).squaredNorm();
  return change > 0.0 ? std::sqrt(rates / change) : 0.0;
}

}  // namespace

MethodChoice::MethodChoice(const CompiledSystem& system)
    : is_automatic_(system.study().solver.method == RosenbrockMethod::kAuto &&
                    system.compliance() == 0.0),
      first_(&first_method(system)),
      states_(IncrementLayout(system.layout()).z()),
      direction_(IncrementLayout(system.layout()).size()) {}

const RosenbrockTableau& MethodChoice::start() {
  stiff_ = others_ = 0;
  waits_ = pause_ = kFirstPause;
  // Without any pattern, so that it has a part along every eigenvector.
  for (Eigen::Index k = 0; k < direction_.size(); ++k)
    direction_[k] = std::sin(1.0 + 7.0 * static_cast<double>(k));
  return *first_;
}

bool MethodChoice::is_stiff(const OneStep<double>& step, bool at_bound) {
  if (at_bound || stiffness(step, states_) > kLimit) {
    others_ = 0;
    return ++stiff_ >= kStiffSteps;
  }
  if (++others_ >= kOtherSteps) stiff_ = 0;
  return false;
}

bool MethodChoice::is_calm(OneStep<double>* step) {
  if (--waits_ > 0) return false;
  waits_ = kLooks;
  return step->step_size() * step->spectral_radius(&direction_) < kCalm;
}

// Each return doubles the pause before the next one, so that a stretch between both costs little.
const RosenbrockTableau& MethodChoice::next(OneStep<double>* step, bool at_bound) {
  const RosenbrockTableau& tableau = step->tableau();
  if (!is_automatic_) return tableau;
  if (tableau.is_explicit()) {
    if (!is_stiff(*step, at_bound)) return tableau;
    stiff_ = others_ = 0;
    waits_ = pause_;
    pause_ = std::min(2 * pause_, kLongestPause);
    return rodas5p();
  }
  return is_calm(step) ? dopri5() : tableau;
}

}  // namespace codesign
