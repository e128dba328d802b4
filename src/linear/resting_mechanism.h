// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "assembly/driven_motion.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/status.h"
#include "observation/observer.h"

namespace codesign {

/// A mechanism at rest in one posture after the other, theory (66). Functions of time keep their
/// values at t = 0, lags and filters of controllers have settled, and the states of their integrals
/// are numbers that may be chosen.
class RestingMechanism {
 public:
  RestingMechanism(const CompiledSystem& system, const std::vector<double>& parameters);

  const CompiledSystem& system() const { return *system_.system; }

  /// Assembles the start of the study.
  Status begin();
  /// Goes to coordinates and integrals near the present ones; stays after a failure.
  Status go_to(const Eigen::VectorXd& q, const Eigen::VectorXd& integrals);
  Status go_to(const Eigen::VectorXd& q) { return go_to(q, integrals()); }

  const VectorX<double>& q() const { return state_.q; }
  Eigen::VectorXd acceleration() const { return state_.z.head(layout_.n); }
  /// The efforts along coordinates that nothing balances in the present posture, without those that
  /// constraints take [N or N m]. @param N of linearize().
  Eigen::VectorXd unbalanced_efforts(const Eigen::MatrixXd& N);
  /// The states of the integrals, and their rates: the errors of their controllers.
  Eigen::VectorXd integrals() const;
  Eigen::VectorXd errors() const;
  /// The state of each controller's integral; 0 without one.
  std::vector<double> integral_of_controllers() const;
  /// The estimates of all observers. They are numbers to be chosen as those of integrals are, in
  /// integrals(), and their rates in errors().
  std::vector<double> estimates_of_controllers() const;
  /// The currents of windings that controllers read, which are such numbers, too.
  std::vector<double> currents() const;
  /// Whether efforts follow from estimates or currents, which settle by themselves.
  bool has_estimates() const { return has_estimates_; }

  /// An orthonormal basis N of the velocities that the constraints allow.
  Status linearize(Eigen::MatrixXd* N);
  /// The derivatives of [accelerations; errors] along the columns of N and by the integrals, after
  /// linearize().
  Eigen::MatrixXd slopes(const Eigen::MatrixXd& N, bool by_integrals);

  void observe(Observer* observer, Frame* frame) {
    observer->observe(state_, 0.0, theta_, &motion_.equations(), frame);
  }
  const State<double>& state() const { return state_; }
  const VectorX<double>& theta() const { return theta_; }

 private:
  const DrivenSystem system_;  ///< nothing is driven
  const Layout& layout_;
  const std::vector<double> parameters_;
  DrivenMotion motion_;
  std::vector<int> integrals_;  ///< indices of extra states: of integrals, estimates, currents
  bool has_estimates_ = false;
  Linearization<double> derivatives_;
  State<double> state_;
  VectorX<double> theta_;
};

/// The windings whose current is a state and a controller reads it.
std::vector<Winding> read_windings(const System& system);

}  // namespace codesign
