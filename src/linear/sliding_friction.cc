// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/sliding_friction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "description/study.h"
#include "elements/joint_load.h"
#include "equations/formulas.h"
#include "linear/linear_motion.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "math/differences.h"
#include "mechanism/motor_sides.h"
#include "mechanism_codesign/error.h"

namespace codesign {
namespace {

constexpr double kUnmoved = 1e-12;   // a part of the fastest joint that does not move
constexpr double kFirstStep = 0.05;  // of the speed, the first step of differences

int joint_of(const System& system, const JointLoad& load) {
  return system.topology().pairs[to_index(load.pair)].chain[to_index(load.element)].joint;
}

/// Whether a coordinate has losses of a gear, but viscous ones.
bool has_gear_loss(const System& system, const JointLoad& load) {
  if (!load.find<GearLoss>()) return false;
  const JointDescription& joint = system.robot().joints[to_index(joint_of(system, load))];
  return load.has_gear_torque || !joint.actuator->gear->coulomb.is_zero();
}

bool has_friction(const System& system, const JointLoad& load) {
  return load.find<BearingFriction>() || load.find<DryFriction>() || has_gear_loss(system, load);
}

/// The friction of one coordinate that slides for long, with the forces of a state at rest.
class SteadyFriction {
 public:
  /// @param formulas with a state loaded, which they keep.
  SteadyFriction(const State<double>& rest, const JointLoad& load, Formulas<double>* formulas)
      : load_(load), state_(rest), formulas_(formulas) {
    if (load.has_gear_torque && load.find<GearLoss>())
      torque_ = gear_torque(formulas->view(), load, 0.0);
  }

  /// Whether all of it has a steady value, and one coordinate. The annotated friction of a cylinder
  /// acts along its turn and its slide, and the damping of a joint along one coordinate.
  bool exists() const {
    const StateView<double>& view = formulas_->view();
    if (load_.find<BearingFriction>() && view.constants(load_.pair).coordinates.size() > 1)
      return false;
    for (const bool of_gear : {false, true})
      if (const BristleContact* bristle = bristle_of(of_gear); bristle && !bristle->model->steady)
        return false;
    return true;
  }

  /// [N or N m], without the viscous friction of a motor, which stays in the model.
  double at(double rate) {
    for (const bool of_gear : {false, true})
      if (const BristleContact* bristle = bristle_of(of_gear)) settle(*bristle, rate);
    formulas_->load(state_);
    const StateView<double>& view = formulas_->view();
    double value = 0.0;
    if (const auto* bearing = load_.find<BearingFriction>())
      value += part_load(view, load_, *bearing, rate);
    if (const auto* dry = load_.find<DryFriction>()) value += part_load(view, load_, *dry, rate);
    if (!load_.find<GearLoss>()) return value;
    const GearConstants<double>& c = view.dynamics(load_.pair, load_.element).gear;
    const double mu = gear_slip(view, load_, rate);
    value += mu * c.coulomb;
    return load_.has_gear_torque ? value + gear_loss(torque_, mu, c) : value;
  }

 private:
  const BristleContact* bristle_of(bool gear) const {
    return formulas_->view().system.bristle(load_.pair, load_.element, gear);
  }
  void settle(const BristleContact& bristle, double rate) {
    const StateView<double>& view = formulas_->view();
    const FrictionConstants<double>& c = bristle_numbers(view, bristle);
    const bool turning = view.coordinate_constants(load_.pair, load_.element).kind ==
                         CoordinateConstants<double>::Kind::kTurn;
    const double arm = turning && !bristle.gear ? c.pin_radius : 1.0;
    const BristleState<double> steady =
        bristle.model->steady.of<double>(Vector3<double>(arm * rate, 0.0, 0.0), c);
    state_.s[bristle.first] = steady.zeta[0];
    if (bristle.dwells()) state_.s[bristle.dwell_state()] = steady.dwell;
  }

  const JointLoad& load_;
  State<double> state_;
  Formulas<double>* formulas_;
  double torque_ = 0.0;
};

double rate_of(const CoordinateIndex& at, const Formulas<double>& formulas) {
  return formulas.view().coordinate(at.pair, at.element, CoordinateDetail::kRate).rate;
}

/// The velocities of a posture in which the joints move as the study starts them, and motors with
/// their joints.
VectorX<double> start_velocities(const LinearCase& of, LinearMotion* motion) {
  const CompiledSystem& system = motion->system();
  const Study& study = of.system->whole_study();
  std::vector<std::pair<CoordinateIndex, double>> given;
  const std::vector<Pair>& pairs = system.topology().pairs;
  for (const InitialJointState& initial : study.initial_state)
    for (std::size_t p = 0; initial.velocity && p < pairs.size(); ++p)
      for (std::size_t e = 0; e < pairs[p].chain.size(); ++e)
        if (system.robot().joints[to_index(pairs[p].chain[e].joint)].name == initial.joint)
          given.push_back(
              {{static_cast<int>(p), static_cast<int>(e)}, initial.velocity->at(of.parameters)});
  const Eigen::MatrixXd& Q = motion->coordinates().Q;
  const std::vector<ElasticGear>& gears = system.elastic_gears();
  const Eigen::Index of_joints = to_signed(given.size());
  Eigen::MatrixXd rows(of_joints + to_signed(gears.size()), Q.cols());
  Eigen::VectorXd speeds = Eigen::VectorXd::Zero(rows.rows());
  State<double> moving = motion->state();
  Formulas<double>& formulas = motion->equations().formulas();
  for (Eigen::Index k = 0; k < Q.cols(); ++k) {
    moving.v = Q.col(k);
    formulas.load(moving);
    for (Eigen::Index row = 0; row < of_joints; ++row)
      rows(row, k) = rate_of(given[to_index(row)].first, formulas);
    for (std::size_t gear = 0; gear < gears.size(); ++gear)
      rows(of_joints + to_signed(gear), k) =
          rate_of(gears[gear].motor, formulas) - rate_of(gears[gear].joint, formulas);
  }
  for (Eigen::Index row = 0; row < of_joints; ++row) speeds[row] = given[to_index(row)].second;
  if (speeds.isZero(0.0))
    throw InputError({{study.file, 1},
                      "initial_state",
                      "friction at a given speed is asked for, and no joint starts with one",
                      "",
                      "a velocity of the joints that slide"});
  return product(Q, least_norm(rows).solve(speeds)).col(0);
}

/// Takes the losses of a gear away and gives its motor viscous friction instead.
/// @param slope at the joint's side. @param joint that has the actuator.
void replace_losses(double slope, const std::vector<double>& parameters, JointDescription* joint) {
  GearDescription& gear = *joint->actuator->gear;
  const double n = joint->actuator->gear_ratio.at(parameters);
  remove_losses(&gear);
  if (slope != 0.0) gear.viscous = Quantity(gear.viscous.at(parameters) + slope / (n * n));
}

/// Takes the friction along a coordinate away and gives its joint damping instead; a motor that
/// moves apart is made of the actuator of its joint.
void replace_friction(const System& system, const JointLoad& load, double slope,
                      const std::vector<double>& parameters, RobotDescription* robot) {
  const int index = joint_of(system, load);
  for (JointDescription& owner : robot->joints)
    if (owner.motor == index) return replace_losses(slope, parameters, &owner);
  JointDescription& joint = robot->joints[to_index(index)];
  if (load.find<BearingFriction>()) joint.friction.reset();
  if (load.find<DryFriction>()) joint.dry_friction = Quantity(0.0);
  if (load.find<GearLoss>()) replace_losses(0.0, parameters, &joint);
  joint.damping = Quantity(joint.damping.at(parameters) + slope);
}

void add_name(const std::string& name, std::vector<std::string>* names) {
  if (std::find(names->begin(), names->end(), name) == names->end()) names->push_back(name);
}

/// Adds the joints whose friction acts along a coordinate.
void add_names(const System& system, const JointLoad& load, std::vector<std::string>* names) {
  const RobotDescription& robot = system.robot();
  const auto add = [&](int joint) {
    add_name(joint_of_motor(robot, robot.joints[to_index(joint)].name), names);
  };
  if (load.find<BearingFriction>())
    add(system.topology().pairs[to_index(load.pair)].friction_joint);
  if (load.find<DryFriction>() || has_gear_loss(system, load)) add(joint_of(system, load));
}

/// Adds the joints and contacts that slip in several directions.
void add_contacts(const System& system, std::vector<std::string>* names) {
  const RobotDescription& robot = system.robot();
  for (const int pair : system.contacts())
    add_name(robot.joints[to_index(system.topology().pairs[to_index(pair)].friction_joint)].name,
             names);
  for (const ContactDescription& contact : robot.contacts)
    if (contact.friction) add_name(contact.name, names);
}

CountedRobot with_slopes(const LinearCase& of, const LinearStudy& study,
                         const State<double>& rest) {
  const CompiledSystem system(of.system->robot(), study.study, of.system->sharing());
  LinearMotion motion(system, study);
  CountedRobot counted{of.system->robot()};
  if (!motion.linearize_at_rest(rest, of.integrals).ok()) return counted;
  const VectorX<double> v = start_velocities(of, &motion);
  State<double> moving = motion.state();
  moving.v = v;
  Formulas<double>& formulas = motion.equations().formulas();
  std::vector<double> rates;
  formulas.load(moving);
  for (const JointLoad& load : system.loads())
    rates.push_back(rate_of({load.pair, load.element}, formulas));
  double fastest = 0.0;
  for (const double rate : rates) fastest = std::max(fastest, std::abs(rate));
  for (std::size_t k = 0; k < rates.size(); ++k) {
    const JointLoad& load = system.loads()[k];
    if (!has_friction(system, load)) continue;
    formulas.load(motion.state());
    SteadyFriction friction(motion.state(), load, &formulas);
    if (!friction.exists() || std::abs(rates[k]) <= kUnmoved * fastest) {
      add_names(system, load, &counted.at_rest);
      continue;
    }
    counted.has_sliding = true;
    const double slope = ridders_derivative([&](double rate) { return friction.at(rate); },
                                            rates[k], kFirstStep * std::abs(rates[k]))
                             .value;
    replace_friction(system, load, slope, study.parameters, &counted.robot);
  }
  add_contacts(system, &counted.at_rest);
  return counted;
}

}  // namespace

CountedRobot counted_robot(const LinearCase& of, const LinearStudy& study,
                           const State<double>& rest) {
  if (!of.at_rest || of.question.friction == LinearFriction::kRegularised)
    return {of.system->robot()};
  if (of.question.friction == LinearFriction::kOff) return {without_friction(of.system->robot())};
  return with_slopes(of, study, rest);
}

}  // namespace codesign
