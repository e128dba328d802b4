// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/method_choice.h"

#include <algorithm>
#include <cmath>

namespace codesign {
namespace {

// Of the code DOPRI5: the limit of stability on the negative real axis, how many steps at it make a stiff stretch, and how many others in a
// row end the count.
constexpr double kLimit = 3.25;
constexpr int kStiffSteps = 15, kOtherSteps = 6;
// A margin against ping-pong, and against the error of the estimate.
constexpr double kCalm = 1.0;
constexpr int kLooks = 8, kFirstPause = 16, kLongestPause = 1024;

bool has_dry_friction(const System& system) {
  return !system.contacts().empty() || std::any_of(system.loads().begin(), system.loads().end(),
                                                   [](const JointLoad& load) { return load.reaction_friction || load.constant_friction; });
}

const RosenbrockTableau& first_method(const System& system) {
  const RosenbrockMethod method = system.study().solver.method;
  if (method != RosenbrockMethod::kAuto) return rosenbrock_tableau(method);
  // Steps of loops that share reactions are watched for singular positions, (23a), which explicit steps are long enough to pass unseen.
  if (system.compliance() > 0.0) return rodas4();
  return has_dry_friction(system) ? rodas5p() : dopri5();
}

}  // namespace

// Dry friction is stiff wherever it sticks. A run that began explicitly would find this out in some fifty steps, and have made the programs
// of both methods.
MethodChoice::MethodChoice(const CompiledSystem& system)
    : is_automatic_(system.study().solver.method == RosenbrockMethod::kAuto && system.compliance() == 0.0),
      first_(&first_method(system)),
      direction_(IncrementLayout(system.layout()).size()) {}

const RosenbrockTableau& MethodChoice::start() {
  stiff_ = others_ = 0;
  waits_ = pause_ = kFirstPause;
  // Without any pattern, so that it has a part along every eigenvector.
  for (Eigen::Index k = 0; k < direction_.size(); ++k) direction_[k] = std::sin(1.0 + 7.0 * static_cast<double>(k));
  return *first_;
}

bool MethodChoice::is_stiff(const RosenbrockStep<double>& step) {
  if (step.stiffness() > kLimit) {
    others_ = 0;
    return ++stiff_ >= kStiffSteps;
  }
  if (++others_ >= kOtherSteps) stiff_ = 0;
  return false;
}

bool MethodChoice::is_calm(RosenbrockStep<double>* step) {
  if (--waits_ > 0) return false;
  waits_ = kLooks;
  return step->step_size() * step->spectral_radius(&direction_) < kCalm;
}

// Each return doubles the pause before the next one, so that a stretch between both costs little.
const RosenbrockTableau& MethodChoice::next(RosenbrockStep<double>* step) {
  const RosenbrockTableau& tableau = step->tableau();
  if (!is_automatic_) return tableau;
  if (tableau.is_explicit()) {
    if (!is_stiff(*step)) return tableau;
    stiff_ = others_ = 0;
    waits_ = pause_;
    pause_ = std::min(2 * pause_, kLongestPause);
    return rodas5p();
  }
  return is_calm(step) ? dopri5() : tableau;
}

}  // namespace codesign
