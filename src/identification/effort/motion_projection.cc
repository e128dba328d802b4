// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/motion_projection.h"

#include <algorithm>
#include <utility>

#include "assembly/assembly.h"
#include "equations/formulas.h"
#include "math/arrays.h"
#include "math/dense.h"

namespace codesign {
namespace {

constexpr int kMostSteps = 50;
// [rad or m] last step of the Gauss-Newton iteration, which converges linearly.
constexpr double kSmallStep = 1e-13;

DriveMotion motion_of(const Eigen::VectorXd (&drives)[3]) {
  return {drives[0], drives[1], drives[2]};
}

}  // namespace

MotionProjection::MotionProjection(const DrivenSystem& driven,
                                   const std::vector<MeasuredJoint>& measured)
    : driven_(driven) {
  const System& system = *driven.system;
  const auto weights = [&measured](const std::vector<int>& of) {
    Eigen::VectorXd result(to_signed(of.size()));
    for (std::size_t k = 0; k < of.size(); ++k) {
      const double deviation = measured[to_index(of[k])].deviation;
      result[to_signed(k)] = 1.0 / (deviation * deviation);
    }
    return result;
  };
  drive_weights_ = weights(driven.drives);
  surplus_weights_ = weights(driven.surplus);
  for (int k : driven.surplus)
    for (std::size_t joint = 0; joint < system.robot().joints.size(); ++joint)
      if (system.robot().joints[joint].name == measured[to_index(k)].name) {
        const CouplingTerm term =
            drive_of(system.robot(), system.topology(), static_cast<int>(joint)).terms.front();
        surplus_.push_back({k, term.pair, term.element});
      }
}

Eigen::VectorXd MotionProjection::part_of(const Eigen::VectorXd& measured) const {
  Eigen::VectorXd part(to_signed(surplus_.size()));
  for (std::size_t k = 0; k < surplus_.size(); ++k)
    part[to_signed(k)] = measured[surplus_[k].measured];
  return part;
}

Eigen::VectorXd MotionProjection::values(int order, DrivenMotion* motion,
                                         const State<double>& state) const {
  Eigen::VectorXd result(to_signed(surplus_.size()));
  Formulas<double>& formulas = motion->equations().formulas();
  formulas.load(state);
  for (std::size_t k = 0; k < surplus_.size(); ++k) {
    const CoordinateMotion<double>& at = formulas.coordinate(surplus_[k].pair, surplus_[k].element);
    result[to_signed(k)] = order == 0 ? at.position : order == 1 ? at.rate : at.acceleration;
  }
  return result;
}

// K = d theta_surplus / d theta_drives: the rates of the surplus joints for a unit rate of each
// drive.
Eigen::MatrixXd MotionProjection::slopes(DrivenMotion* motion, const State<double>& state) const {
  const System& system = motion->system();
  Eigen::MatrixXd K(to_signed(surplus_.size()), motion->drives());
  State<double> moved = state;
  VectorX<double> unit(system.layout().columns());
  for (int drive = 0; drive < motion->drives(); ++drive) {
    unit.setZero();
    unit[system.layout().lambda_column(system.drive_row(drive))] = 1.0;
    motion->lu().solve(unit);
    moved.v = unit.head(system.layout().n);
    K.col(drive) = values(1, motion, moved);
  }
  return K;
}

Eigen::VectorXd MotionProjection::correction(const Eigen::MatrixXd& K,
                                             const Eigen::VectorXd& drive_misses,
                                             const Eigen::VectorXd& surplus_misses) const {
  const Eigen::MatrixXd weighted = K.transpose() * surplus_weights_.asDiagonal();
  Eigen::MatrixXd normal = product(weighted, K);
  normal.diagonal() += drive_weights_;
  return solve_positive_definite(
      normal, drive_weights_.cwiseProduct(drive_misses) + weighted * surplus_misses);
}

Status MotionProjection::project(const Eigen::VectorXd (&measured)[3], Eigen::VectorXd (*drives)[3],
                                 DrivenMotion* motion, State<double>* state) const {
  const Eigen::VectorXd given[] = {(*drives)[0], (*drives)[1], (*drives)[2]};
  Eigen::MatrixXd K;
  for (int step = 0; step < kMostSteps; ++step) {
    if (Status status = motion->follow(motion_of(*drives), state); !status.ok()) return status;
    if (Status status = motion->linearize(*state); !status.ok()) return status;
    K = slopes(motion, *state);
    const Eigen::VectorXd change =
        correction(K, given[0] - (*drives)[0], part_of(measured[0]) - values(0, motion, *state));
    (*drives)[0] += change;
    if (change.cwiseAbs().maxCoeff() < kSmallStep) break;
  }
  // Velocities of surplus joints are K times the velocities of the drives, and so are
  // accelerations, up to known terms: each order is one linear problem.
  for (int order : {1, 2}) {
    (*drives)[order] += correction(K, Eigen::VectorXd::Zero(given[order].size()),
                                   part_of(measured[order]) - values(order, motion, *state));
    if (Status status = motion->follow(motion_of(*drives), state); !status.ok()) return status;
  }
  return {};
}

DrivenReplay::DrivenReplay(const CompiledSystem& system, std::vector<MeasuredJoint> joints,
                           const Eigen::MatrixXd& positions, const std::vector<double>& parameters,
                           const std::vector<SignalDescription>& signals)
    : system_(system),
      joints_(std::move(joints)),
      parameters_(parameters),
      driven_(make_driven_system(system, joints_, positions)),
      motion_(driven_),
      projection_(driven_, joints_),
      observer_(*driven_.system, signals) {
  motion_.set_design(parameters_);
  const std::vector<std::string>& names = observer_.names().joints;
  for (const int k : driven_.drives)
    drives_.push_back(
        to_index(std::find(names.begin(), names.end(), joints_[to_index(k)].name) - names.begin()));
}

Status DrivenReplay::begin(const Eigen::VectorXd& positions) {
  StartWorkspace usual(system_, parameters_);
  if (Status status = usual.solve_positions(); !status.ok()) return status;
  theta_ = usual.assembly.theta();
  return assemble_driven(system_, joints_, driven_, parameters_, positions, &state_);
}

Status DrivenReplay::show(double time, const Eigen::VectorXd (&measured)[3], Frame* frame) {
  state_.t = time;
  Eigen::VectorXd drives[3];
  for (int order = 0; order < 3; ++order) {
    drives[order].resize(to_signed(driven_.drives.size()));
    for (std::size_t k = 0; k < driven_.drives.size(); ++k)
      drives[order][to_signed(k)] = measured[order][driven_.drives[k]];
  }
  const auto part = [&](int order) {
    return In<double>(drives[order].data(), drives[order].size());
  };
  Status status = projection_.empty() ? motion_.follow({part(0), part(1), part(2)}, &state_)
                                      : projection_.project(measured, &drives, &motion_, &state_);
  if (status.ok()) observer_.observe(state_, 0.0, theta_, &motion_.equations(), frame);
  return status;
}

bool DrivenReplay::is_singular() {
  // A position that is solved for is off a singular one by the square root of its tolerance: other
  // joints move as many times as fast as the drive.
  constexpr double kLongestLever = 1e5;
  return motion_.fastest_follower(state_) > kLongestLever;
}

}  // namespace codesign
