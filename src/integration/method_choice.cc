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
// Of trials: explicit steps before the first one, implicit steps of each, whose size has to grow
// first, and the share of a step in the smoothed size. The cost is that of an explicit step with a
// factorization in each stage by that of an implicit one, measured from 1.4 (a governor) to 2.8 (a
// chain of 1,000 links); decision 84.
constexpr int kFirstLook = 24, kTrial = 12;
constexpr double kSmoothing = 0.25, kExplicitCost = 1.5;

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
  begin_explicitly(kFirstLook);
  waits_ = pause_ = kFirstPause;
  pace_ = 0.0;
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

/// A trial of implicit steps is due: the method that goes farther at the same cost is not known
/// where every explicit stage factors a matrix.
bool MethodChoice::is_due(OneStep<double>* step) {
  return ++explicit_ >= look_ && step->equations().mass_factor() == nullptr;
}

void MethodChoice::begin_explicitly(int look) {
  look_ = look;
  explicit_ = stiff_ = others_ = trial_ = 0;
}

// Each return doubles the pause before the next one, so that a stretch between both costs little.
void MethodChoice::begin_implicitly() {
  trial_ = 0;
  waits_ = pause_;
  pause_ = std::min(2 * pause_, kLongestPause);
}

const RosenbrockTableau& MethodChoice::next(OneStep<double>* step, bool at_bound) {
  const RosenbrockTableau& tableau = step->tableau();
  if (!is_automatic_) return tableau;
  pace_ = pace_ > 0.0 ? pace_ + kSmoothing * (step->step_size() - pace_) : step->step_size();
  if (tableau.is_explicit()) {
    if (is_stiff(*step, at_bound)) {
      begin_implicitly();
    } else if (is_due(step)) {
      explicit_pace_ = pace_;
      trial_ = kTrial;
    } else {
      return tableau;
    }
    pace_ = 0.0;
    return rodas5p();
  }
  if (trial_ > 0) {
    if (--trial_ > 0) return tableau;
    if (explicit_pace_ < kExplicitCost * pace_) {
      begin_implicitly();
      return tableau;
    }
    begin_explicitly(std::min(2 * look_, kLongestPause));
  } else if (is_calm(step)) {
    begin_explicitly(kFirstLook);
  } else {
    return tableau;
  }
  pace_ = 0.0;
  return dopri5();
}

}  // namespace codesign
