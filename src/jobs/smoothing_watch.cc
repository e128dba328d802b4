// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/smoothing_watch.h"

#include <algorithm>
#include <cmath>

#include "elements/design.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "mechanism/motor_sides.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kMost = 0.01;  // of the load
// A bearing whose normal force is no more than this many times a default that follows the machine
// carries nothing but this default.
constexpr double kNothing = 20.0;

struct GearAt {
  std::size_t pair, element;
  const JointDescription* joint;  ///< with the actuator; of an elastic gear that of the motor
  std::string name;               ///< in signals
};

std::vector<GearAt> gears_with_losses(const CompiledSystem& system) {
  std::vector<GearAt> gears;
  for (const JointLoad& load : system.loads()) {
    if (!load.find<GearLoss>() || !load.has_gear_torque) continue;
    const auto p = to_index(load.pair), e = to_index(load.element);
    const JointDescription& joint =
        system.robot().joints[to_index(system.topology().pairs[p].chain[e].joint)];
    if (joint.actuator->gear->efficiency)
      gears.push_back({p, e, &joint, joint_of_motor(system.robot(), joint.name)});
  }
  return gears;
}

}  // namespace

std::vector<SignalDescription> SmoothingWatch::signals(const Problem& problem) {
  std::vector<SignalDescription> signals;
  for (const GearAt& gear : gears_with_losses(*system_of(problem)))
    signals.push_back({gear.name + "/gear_torque", {{1.0, gear.name, "gear_torque", ""}}, {}});
  return signals;
}

SmoothingWatch::SmoothingWatch(const Problem& problem, const std::vector<double>& parameters,
                               const FrameNames& names) {
  const CompiledSystem& system = *system_of(problem);
  Design<double> design;
  design.set(system, parameters);
  for (std::size_t p = 0; p < system.topology().pairs.size(); ++p) {
    const int index = system.topology().pairs[p].friction_joint;
    if (index < 0) continue;
    const JointDescription& joint = system.robot().joints[to_index(index)];
    const auto found = std::find(names.frictions.begin(), names.frictions.end(), joint.name);
    if (joint.friction->is_direct || found == names.frictions.end()) continue;
    const FrictionConstants<double>& f = design.constants.pairs[p].friction;
    watched_.push_back({joint.friction->where, joint.element() + " <codesign:friction>",
                        "normal force", to_index(found - names.frictions.begin()), false,
                        !joint.friction->smoothing.is_zero(), f.smoothing, f.preload, 0.0});
  }
  std::size_t place = 0;
  for (const GearAt& gear : gears_with_losses(system)) {
    const FrictionConstants<double>& f =
        design.constants.pairs[gear.pair].dynamics[gear.element].gear.slip;
    watched_.push_back(
        {gear.joint->actuator->where, "<joint name=\"" + gear.name + "\"> <codesign:actuator>",
         "transmitted torque", place++, true, !gear.joint->actuator->gear->slip.smoothing.is_zero(),
         f.smoothing, 0.0, 0.0});
  }
}

void SmoothingWatch::observe(const Frame& frame, std::size_t first) {
  for (Watched& watched : watched_) {
    const double load = watched.is_gear ? frame.signals[first + watched.sample]
                                        : frame.frictions[watched.sample].normal_force;
    watched.largest = std::max(watched.largest, std::abs(load) - watched.preload);
  }
}

Warnings SmoothingWatch::warnings() const {
  Warnings all;
  for (const Watched& watched : watched_) {
    if (watched.smoothing <= kMost * watched.largest) continue;
    if (!watched.is_given && watched.largest <= kNothing * watched.smoothing) continue;
    all.push_back(
        warn("large_smoothing",
             {watched.where, watched.element,
              "the smoothing is more than 1 % of what it smooths: the " + watched.load +
                  " is at most " + readable(watched.largest) +
                  " in this run, and friction follows the "
                  "smoothing",
              to_decimal(watched.smoothing), "a smoothing of less than a hundredth of the load"}));
  }
  return all;
}

}  // namespace codesign
