// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/driven_system.h"

#include <algorithm>
#include <string>

#include "assembly/assembly.h"
#include "control/reference.h"
#include "description/study.h"
#include "math/arrays.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

// As in Assembly; a redundant row with rounded angles and lengths leaves less than this.
constexpr double kRankOfMotion = 1e-3;

std::string list_of(const std::vector<MeasuredJoint>& measured) {
  std::string names;
  for (const MeasuredJoint& joint : measured)
    names += (names.empty() ? "'" : ", '") + joint.name + "'";
  return names.empty() ? "none" : names;
}

/// The index in RobotDescription::joints of a measured joint. @throws InputError
int find_joint(const RobotDescription& robot, const MeasuredJoint& measured) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < robot.joints.size(); ++k) {
    const JointDescription& joint = robot.joints[k];
    if (joint.is_loop || !joint.has_one_coordinate()) continue;
    if (joint.name == measured.name) return static_cast<int>(k);
    names.push_back(joint.name);
  }
  throw unknown_name(measured.where, "identify", "joint with one coordinate", measured.name, names);
}

std::vector<int> find_joints(const RobotDescription& robot,
                             const std::vector<MeasuredJoint>& measured) {
  std::vector<int> joints;
  for (const MeasuredJoint& joint : measured) {
    joints.push_back(find_joint(robot, joint));
    if (std::count(joints.begin(), joints.end(), joints.back()) > 1)
      throw InputError(
          {joint.where, "identify", "the joint is measured twice", joint.name, "each joint once"});
  }
  return joints;
}

/// The study without everything that drives joints. A driven motion needs derivatives by positions
/// and velocities only along directions: with this method their matrices are not recorded.
Study without_control(Study study) {
  study.solver.integrator = IntegratorKind::kRosenbrock;
  study.solver.method = RosenbrockMethod::kAuto;
  study.controllers.clear();
  study.motion.clear();
  study.rigid_gears = true;
  study.integral.clear();
  study.terminal.clear();
  study.watched.clear();
  return study;
}

void refuse_friction_states(const CompiledSystem& system) {
  if (system.bristles().empty()) return;
  const BristleContact& contact = system.bristles().front();
  const Pair& pair = system.topology().pairs[to_index(contact.pair)];
  const int index =
      contact.gear ? pair.chain[to_index(contact.element)].joint : pair.friction_joint;
  const JointDescription& joint = system.robot().joints[to_index(index)];
  throw InputError(
      {contact.gear ? joint.actuator->where : joint.friction->where,
       joint.element() + (contact.gear ? " <codesign:actuator>" : " <codesign:friction>"),
       "the friction law has states, which the motion at one instant does not determine",
       contact.model->name,
       "brown_mcphee for residuals in effort; residuals in motion for laws with states"});
}

bool reads_setpoint(const LoadFunction&, const Signal& signal) {
  return std::any_of(signal.begin(), signal.end(), [](const SignalReference& term) {
    return term.kind == SignalKind::kControllerSetpoint;
  });
}

bool reads_clock(const LoadFunction& function, const Signal& signal) {
  return reads_time(signal) ||
         (!signal.formula && function.of_time.kind != ReferenceDescription::Kind::kConstant);
}

/// @throws InputError for a load with a component for which `is_refused` holds.
void refuse_loads(const CompiledSystem& system,
                  bool (*is_refused)(const LoadFunction&, const Signal&), const std::string& reason,
                  const std::string& allowed) {
  const std::vector<LoadDescription>& loads = system.study().loads;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const LoadSignals& signals = system.load_signals()[k];
    bool any = is_refused(loads[k].effort, signals.effort);
    for (std::size_t axis = 0; axis < 3; ++axis)
      any = any || is_refused(loads[k].force[axis], signals.force[axis]) ||
            is_refused(loads[k].torque[axis], signals.torque[axis]);
    if (any)
      throw InputError({loads[k].where, "loads[" + std::to_string(k) + "]", reason, "", allowed});
  }
}

/// Inverse dynamics drive joints of the tree.
void refuse_motions_of_loops(const CompiledSystem& of) {
  for (const GivenMotion& motion : of.whole_study().motion)
    for (const JointDescription& joint : of.robot().joints)
      if (joint.is_loop && joint.name == motion.joint)
        throw InputError({motion.where, "motion." + motion.joint,
                          "inverse dynamics need the motion of joints of the tree, and this is the "
                          "joint of a loop",
                          motion.joint,
                          "the motion of a joint of the tree instead; identify has residual: "
                          "motion for it, and simulations"});
}

/// The mechanism without the motions that its study gives. Their joints are where they begin.
CompiledSystem without_motions(const CompiledSystem& of) {
  Study study = of.whole_study();
  for (const GivenMotion& motion : study.motion) {
    std::vector<InitialJointState>& starts = study.initial_state;
    starts.erase(
        std::remove_if(starts.begin(), starts.end(),
                       [&](const InitialJointState& start) { return start.joint == motion.joint; }),
        starts.end());
    InitialJointState& start = starts.emplace_back();
    start.joint = motion.joint;
    start.position = Quantity(Reference<double>(motion.position, of.parameters()).at(0.0).value);
  }
  study.motion.clear();
  return {of.robot(), std::move(study), of.sharing()};
}

/// The study with a start near measured positions: the joints of `held` (indices in `joints`) have
/// these positions, and the assembly seeks the other joints from there or from their positions at
/// the study's own start.
/// @param usual holds positions at the study's own start. @param joints indices in the description.
/// @param positions one per joint.
Study study_near(const StartWorkspace& usual, const CompiledSystem& of,
                 const std::vector<int>& joints, const Eigen::VectorXd& positions,
                 const std::vector<int>& held) {
  Study study = without_control(of.whole_study());
  study.initial_state.clear();
  for (std::size_t joint = 0; joint < of.robot().joints.size(); ++joint) {
    const JointDescription& description = of.robot().joints[joint];
    if (description.is_loop || !description.has_one_coordinate()) continue;
    InitialJointState& initial = study.initial_state.emplace_back();
    initial.joint = description.name;
    const auto k = static_cast<int>(
        std::find(joints.begin(), joints.end(), static_cast<int>(joint)) - joints.begin());
    const bool known = k < static_cast<int>(joints.size());
    if (known && std::binary_search(held.begin(), held.end(), k))
      initial.position = Quantity(positions[k]);
    else
      initial.guess =
          known ? positions[k] : usual.assembly.theta()[usual.assembly.tree().offset[joint]];
  }
  return study;
}

/// Chooses the tree coordinates that depend on the others: preferably coordinates that are not
/// measured, then coordinates without an effort.
class DependentCoordinates {
 public:
  /// @param system the rank is examined at its start.
  DependentCoordinates(const CompiledSystem& system, const std::vector<MeasuredJoint>& measured,
                       const std::vector<int>& joints)
      : system_(system), measured_(measured), joints_(joints), start_(system, system.parameters()) {
    if (Status status = start_.solve_positions(); !status.ok())
      throw InputError({{system.whole_study().file, 0},
                        "initial_state",
                        status.cause,
                        "",
                        "a start that can be assembled"});
    find();
  }

  DrivenSystem sort_out() const {
    const TreeLayout& tree = start_.assembly.tree();
    for (std::size_t joint = 0; joint < system_.robot().joints.size(); ++joint)
      require_determined(tree, static_cast<int>(joint));
    DrivenSystem driven;
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      const bool moves_mass = system_.topology().joint_pair[to_index(joints_[k])] >= 0;
      if (!moves_mass && !measured_[k].with_effort)
        continue;  // for example a tool's frame, which needs no effort
      (depends(tree.offset[to_index(joints_[k])]) ? driven.surplus : driven.drives)
          .push_back(static_cast<int>(k));
    }
    for (int k : driven.surplus)
      if (const MeasuredJoint& joint = measured_[to_index(k)]; joint.with_effort)
        throw InputError({joint.where, "identify",
                          "more joints have an effort than the mechanism has degrees of freedom, "
                          "so that their efforts are not determined by "
                          "the motion",
                          joint.name,
                          "efforts of " + std::to_string(driven.drives.size()) +
                              " independent joints; here " + drive_names(driven) +
                              " are, at the start of the study"});
    return driven;
  }

 private:
  bool depends(int coordinate) const {
    return std::binary_search(dependent_.begin(), dependent_.end(), coordinate);
  }

  std::string drive_names(const DrivenSystem& driven) const {
    std::vector<MeasuredJoint> names;
    for (int k : driven.drives) names.push_back(measured_[to_index(k)]);
    return list_of(names);
  }

  void find() {
    const TreeLayout& tree = start_.assembly.tree();
    const LoopJacobian& loops = start_.assembly.loops();
    ColumnPreferences preferences(3);
    std::vector<std::size_t> list(to_index(tree.size), 0);
    for (std::size_t k = 0; k < joints_.size(); ++k)
      list[to_index(tree.offset[to_index(joints_[k])])] = measured_[k].with_effort ? 2 : 1;
    for (int c = 0; c < tree.size; ++c) preferences[list[to_index(c)]].push_back(c);
    const SparseMatrix J =
        loops.evaluate(start_.parameters, start_.assembly.theta(), start_.equations);
    const LoopScales scales = loops.scales(J, start_.equations);
    dependent_ = independent_columns(scales.rows.asDiagonal() * J * scales.columns.asDiagonal(),
                                     preferences, kRankOfMotion);
  }

  void require_determined(const TreeLayout& tree, int joint) const {
    const JointDescription& description = system_.robot().joints[to_index(joint)];
    if (description.is_loop || system_.topology().joint_pair[to_index(joint)] < 0)
      return;                          // such a joint moves no mass
    if (description.is_motor) return;  // gears are rigid where the motion is given
    if (std::find(joints_.begin(), joints_.end(), joint) != joints_.end()) return;
    const int first = tree.offset[to_index(joint)];
    for (int c = first; c < first + description.freedoms().size(); ++c)
      if (!depends(c))
        throw InputError(
            {description.where, description.element(),
             "its motion is not determined: it is not measured, and does not follow from the "
             "measured joints",
             "measured: " + list_of(measured_),
             "recordings that contain this joint, or as many as there are degrees of freedom"});
  }

  const CompiledSystem& system_;
  const std::vector<MeasuredJoint>& measured_;
  const std::vector<int>& joints_;
  StartWorkspace start_;
  std::vector<int> dependent_;
};

/// The drives at the study's start or, if the rank there is an exception (a stretched-out linkage),
/// at the first measured position with the right number of drives.
DrivenSystem choose_drives(const CompiledSystem& of, const std::vector<MeasuredJoint>& measured,
                           const std::vector<int>& joints, const Eigen::MatrixXd& positions) {
  try {
    return DependentCoordinates(of, measured, joints).sort_out();
  } catch (const InputError&) {
    StartWorkspace usual(of, of.parameters());
    if (!of.whole_study().motion.empty() || !usual.solve_positions().ok()) throw;
    // Joints that are probably driven: they keep the linkage from returning to its former position.
    std::vector<int> held;
    for (std::size_t k = 0; k < measured.size(); ++k)
      if (measured[k].with_effort) held.push_back(static_cast<int>(k));
    for (Eigen::Index sample = 0; sample < positions.cols(); ++sample) {
      try {
        const CompiledSystem there(
            of.robot(), study_near(usual, of, joints, positions.col(sample), held), of.sharing());
        return DependentCoordinates(there, measured, joints).sort_out();
      } catch (const InputError&) {  // the first error is more helpful
      }
    }
    throw;
  }
}

}  // namespace

DrivenSystem make_driven_system(const CompiledSystem& of,
                                const std::vector<MeasuredJoint>& measured,
                                const Eigen::MatrixXd& positions,
                                const std::vector<SignalDescription>& signals) {
  refuse_motions_of_loops(of);
  const std::vector<int> joints = find_joints(of.robot(), measured);
  refuse_friction_states(of);
  refuse_loads(of, reads_setpoint, "controllers have no part in a recorded motion",
               "loads that do not read a set-point");
  DrivenSystem driven = of.whole_study().motion.empty()
                            ? choose_drives(of, measured, joints, positions)
                            : choose_drives(without_motions(of), measured, joints, positions);
  std::vector<int> drives;
  for (int k : driven.drives) drives.push_back(joints[to_index(k)]);
  Study study = without_control(of.whole_study());
  for (const SignalDescription& signal : signals)
    study.watched.push_back(compared_signal(signal, study.duration));
  driven.system =
      std::make_shared<const CompiledSystem>(of.robot(), std::move(study), of.sharing(), drives);
  return driven;
}

WatchedSignal compared_signal(const SignalDescription& signal, double duration) {
  WatchedSignal watched;
  watched.signal = signal;
  watched.element = "identify.data";
  watched.before = duration;
  return watched;
}

InputFault in_words_of_study(InputFault fault, const std::string& element,
                             const std::string& undetermined, const std::string& allowed) {
  if (fault.element == "identify") fault.element = element;
  if (fault.allowed.rfind("recordings", 0) == 0) {
    fault.message = undetermined;
    fault.allowed = allowed;
  }
  return fault;
}

void refuse_loads_of_time(const CompiledSystem& system, const std::string& reason) {
  refuse_loads(system, reads_clock, reason, "loads that are constant or depend on the motion");
}

std::vector<std::string> independent_joints(const CompiledSystem& of,
                                            std::vector<MeasuredJoint> measured,
                                            const Eigen::MatrixXd& positions) {
  std::vector<std::string> names;
  for (MeasuredJoint& joint : measured)
    joint.with_effort = joint.with_effort && !has_given_motion(of.whole_study(), joint.name);
  for (int k : choose_drives(of, measured, find_joints(of.robot(), measured), positions).drives)
    names.push_back(measured[to_index(k)].name);
  for (const JointDescription& joint : of.robot().joints)
    if (joint.is_motor) names.push_back(joint.name);
  return names;
}

Status assemble_driven(const CompiledSystem& of, const std::vector<MeasuredJoint>& measured,
                       const DrivenSystem& driven, const std::vector<double>& parameters,
                       const Eigen::VectorXd& positions, State<double>* state) {
  StartWorkspace usual(of, parameters);
  if (Status status = usual.solve_positions(); !status.ok()) return status;
  const CompiledSystem first(
      of.robot(),
      study_near(usual, of, find_joints(of.robot(), measured), positions, driven.drives),
      of.sharing());
  StartWorkspace start(first, parameters);
  if (Status status = start.solve_positions(); !status.ok()) return status;
  state->resize(driven.system->layout());
  state->q = start.state.q;
  state->turns = start.state.turns;
  return {};
}

}  // namespace codesign
