// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/command_inputs.h"

#include <algorithm>
#include <set>

#include "math/arrays.h"
#include "mechanism/constants.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

// [m/s or rad/s] without controllers no speed is known beyond which a commanded motion runs away.
constexpr double kAnySpeed = 1e9;

constexpr double kMostSteps = 2e9;

using Kind = CoordinateConstants<double>::Kind;

bool is_drivable(const CompiledSystem& system, const Constants<double>& constants, std::size_t k) {
  const JointDescription& joint = system.robot().joints[k];
  const int pair = system.topology().joint_pair[k];
  if (joint.is_motor || joint.is_loop || joint.mimic || !joint.has_one_coordinate() || pair < 0 ||
      has_given_motion(system.study(), joint.name))
    return false;
  const std::vector<ChainElement>& chain = system.topology().pairs[to_index(pair)].chain;
  const auto& coordinates = constants.pairs[to_index(pair)].coordinates;
  for (std::size_t e = 0; e < chain.size() && e < coordinates.size(); ++e)
    if (chain[e].joint == static_cast<int>(k)) return coordinates[e].kind != Kind::kNone;
  return false;
}

// Inverse dynamics need the joint which they drive: without it a controller shows its feedback part
// alone.
void disconnect(const std::vector<std::string>& names, Study* study) {
  std::vector<std::string> known;
  for (const ControllerDescription& controller : study->controllers)
    known.push_back(controller.name);
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end())
      throw unknown_name({"disconnect", 0}, name, "controller", name, known);
    ControllerDescription& controller = study->controllers[to_index(found - known.begin())];
    if (controller.kind->load != ControlLoad::kNone) controller.kind = ControllerKind::kPid;
    controller.output.clear();
  }
}

/// Whether a controller is applied.
bool drives(const MotionStudy& study) {
  return std::any_of(study.controllers.begin(), study.controllers.end(),
                     [](const auto& controller) { return !controller.output.empty(); });
}

void check_joints(const std::vector<std::string>& joints, const std::vector<std::string>& known,
                  const MotionStudy& study) {
  std::set<std::string> seen;
  for (const std::string& joint : joints) {
    refuse_given_motion(study, joint, "command_joints", known);
    if (std::find(known.begin(), known.end(), joint) == known.end())
      throw unknown_name({"command_joints", 0}, joint, "joint that can be driven", joint, known);
    if (!seen.insert(joint).second)
      throw InputError(
          {{"command_joints", 0}, joint, "the joint is named twice", joint, "each joint once"});
  }
}

}  // namespace

std::shared_ptr<LiveFunction> make_live(ReferenceDescription* reference) {
  auto function = std::make_shared<LiveFunction>();
  auto planned = std::make_shared<const ReferenceDescription>(*reference);
  reference->kind = ReferenceDescription::Kind::kLive;
  reference->live = {function, std::move(planned)};
  return function;
}

void refuse_given_motion(const MotionStudy& study, const std::string& joint,
                         const std::string& from, const std::vector<std::string>& known) {
  if (has_given_motion(study, joint))
    throw InputError({{from, 0},
                      joint,
                      "the study gives the motion of the joint, on which an effort has no effect",
                      joint,
                      list_names(known)});
}

std::vector<std::string> drivable_joints(const CompiledSystem& system) {
  const Constants<double> constants =
      evaluate_constants(system.robot(), system.topology(), system.parameters());
  std::vector<std::string> joints;
  for (std::size_t k = 0; k < system.robot().joints.size(); ++k)
    if (is_drivable(system, constants, k)) joints.push_back(system.robot().joints[k].name);
  return joints;
}

CommandInputs::CommandInputs(const CompiledSystem& of, const CommandOptions& options)
    : study(of.whole_study()), joints(drivable_joints(of)) {
  if (options.joints) {
    check_joints(*options.joints, joints, study);
    joints = *options.joints;
  }
  disconnect(options.disconnected, &study);
  if (!drives(study) && !joints.empty() && !(study.solver.maximum_speed > 0.0))
    study.solver.maximum_speed = kAnySpeed;
  if (options.duration) {
    // As many steps for each second as the study allows.
    const double factor = std::max(1.0, *options.duration / study.duration);
    study.solver.maximum_steps =
        static_cast<int>(std::min(kMostSteps, factor * study.solver.maximum_steps));
    // A mechanism at rest takes steps of any length: none shall reach far beyond the time at which
    // the run is looked at, since its end would be checked and reported there.
    if (factor > 1.0 && !(study.solver.maximum_step > 0.0))
      study.solver.maximum_step = study.duration;
    if (factor > 1.0) study.balance_time = study.duration;
    study.duration = *options.duration;
    study.duration_of_design.reset();
  }
  // Commands make steps that the study did not count: one that ends at the command, and a short one
  // that begins there.
  study.solver.maximum_steps = static_cast<int>(
      std::min(kMostSteps, study.solver.maximum_steps + 2.0 * options.rate * study.duration));
  for (std::size_t c = 0; c < study.controllers.size(); ++c) {
    const std::string& name = study.controllers[c].name;
    const auto& without = options.disconnected;
    if (!study.controllers[c].kind->has_error() ||
        std::find(without.begin(), without.end(), name) != without.end())
      continue;
    controllers.push_back(name);
    indices.push_back(c);
    setpoints.push_back(make_live(&study.controllers[c].setpoint));
  }
  std::vector<ControllerDescription> first;
  for (const std::string& joint : joints) {
    ControllerDescription& controller = first.emplace_back();
    controller.name = "command of " + joint;
    controller.kind = ControllerKind::kStateFeedback;
    controller.output = joint;
    efforts.push_back(make_live(&controller.feedforward));
  }
  study.controllers.insert(study.controllers.begin(), first.begin(), first.end());
}

std::optional<TrajectoryFollower> follower_of(const CommandInputs& inputs,
                                              const std::string& joint) {
  for (const char* const quantity : {"position", "velocity"}) {
    for (std::size_t k = 0; k < inputs.controllers.size(); ++k) {
      const ControllerDescription& controller =
          inputs.study.controllers[inputs.joints.size() + inputs.indices[k]];
      if (!controller.output.empty() && controller.output != joint) continue;
      const SignalTerm* input = controller.input.only_term();
      if (input && input->object == joint && input->quantity == quantity)
        return TrajectoryFollower{k, quantity[0] == 'v'};
    }
  }
  return std::nullopt;
}

}  // namespace codesign
