// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <memory>
#include <optional>

#include "integration/rosenbrock_integrator.h"
#include "sensitivity/control_directions.h"
#include "sensitivity/end_motion.h"
#include "sensitivity/gradient_engine.h"
#include "sensitivity/lane_directions.h"
#include "sensitivity/one_sided.h"
#include "sensitivity/residual_rows.h"
#include "sensitivity/signal_watch.h"
#include "sensitivity/tangent_step.h"

namespace codesign {

/// Gradient by the exact tangent of the Rosenbrock steps (direct sensitivities); doc/theory.md
/// (18), (22).
///
/// If the tangents of all parameters do not fit into memory, gradient() repeats the run for each
/// further group of parameters.
class RosenbrockGradient final : public GradientEngine {
 public:
  /// @param most_lanes largest number of parameters per run; 0: as many as fit into 128 MB.
  explicit RosenbrockGradient(const CompiledSystem& system, int most_lanes = 0);

  Status start(const std::vector<double>& parameters, Derivatives derivatives) override;
  Status advance(double limit) override;
  /// Carries state and sensitivities over changes of the mode and events of sampled controllers,
  /// theory (17d), (51); advance() begins with it.
  Status jump();
  /// Size of the last step [s].
  double step_size() const { return integrator_.step().step_size(); }
  /// Its method.
  const RosenbrockTableau& tableau() const { return integrator_.step().tableau(); }
  const RosenbrockIntegrator& integrator() const override { return integrator_; }
  /// How the end of the run moves; after a run with gradient.
  const EndMotion& end_motion() const { return end_; }
  double objective() override;
  void gradient(Eigen::VectorXd* gradient) override;
  void jacobian_root(Eigen::MatrixXd* root) override {
    residuals_.finish(integrator_.state(), root);
  }
  const Extremes& extremes() const override { return watch_.extremes(); }
  /// SignalWatch::slopes().
  const Eigen::VectorXd& slopes() const { return watch_.slopes(); }
  /// The guard at whose zero the last step ended, with its rate there, where that moves watched
  /// signals; -1 if none did.
  struct Switch {
    int guard = -1;
    double rate = 0.0;  ///< s_t + s_x f- [per s]
  };
  const Switch& last_switch() const { return switch_; }
  const Statistics& statistics() const override { return integrator_.statistics(); }
  Warnings warnings() const override {
    Warnings all = integrator_.warnings();
    append(one_sided_.warnings(), &all);
    return all;
  }
  const EventLog* events() const override { return &integrator_.events(); }
  void obey(const std::atomic<bool>* cancel) override { integrator_.obey(cancel); }

 private:
  template <int N>
  struct Group {
    Group(const CompiledSystem& system, LaneRange<N> lanes, const RosenbrockTableau& tableau)
        : range(lanes), step(system, tableau) {}
    LaneRange<N> range;
    std::vector<Lanes<N>> parameters;  ///< with the directions of `range`
    TangentStep<N> step;
    Directions<N> integral_residuals, terminal_residuals;  ///< derivatives, one column per term
  };

  int count() const { return static_cast<int>(system_.study().tuned.size()); }
  /// Number of parameters per run. Rows of watched signals and residuals are collected during one
  /// run, which then includes all parameters.
  int most_lanes() const {
    return watch_.is_empty() && !with_root_ ? most_lanes_ : std::max(4, count());
  }
  /// Whether the sensitivities of the parameters, all in one run, are those of the error test.
  bool judges_parameters() const;
  Status start_watches();
  /// Starts the tangents of the parameters from `first` on.
  void carry(int first, const std::vector<double>& parameters);
  void accept();
  /// Finds out how the end of the run moves, if it has ended.
  Status look_at_end();
  void look_at_jump();
  /// Finds out how the instant moves at which a guard has ended the last step.
  Status look_at_switch();
  /// tau' of theory (18g) by all parameters.
  void guard_time(int guard, double rate, const State<double>& end, Eigen::VectorXd* time);
  /// @param end of the run, with its z.
  void collect(const State<double>& end, Eigen::VectorXd* gradient);
  template <int N>
  void collect(Group<N>* group, const State<double>& end, Eigen::VectorXd* gradient) const;
  void look_beyond_end(const Eigen::VectorXd& gradient);
  void differentiate(std::size_t watched, const State<double>& state, bool reads_rates,
                     Eigen::VectorXd* gradient);
  void differentiate_residuals(ObjectivePart part, const State<double>& state,
                               Eigen::MatrixXd* rows);

  const CompiledSystem& system_;
  RosenbrockIntegrator integrator_;
  const int most_lanes_;
  /// first parameter of `groups_`, and number of parameters in `groups_`
  int first_ = -1, lanes_ = 0;
  std::optional<LaneGroups<Group>> groups_;
  std::unique_ptr<ControlTangent> control_;  ///< unless judges_parameters()
  RosenbrockIntegrator::BeforeAccept stages_;
  SignalWatch watch_;
  ResidualRows residuals_;
  EndMotion end_;
  OneSidedGradient one_sided_;
  Eigen::VectorXd time_of_jump_;  ///< derivatives of the time of a jump that ends the run
  Switch switch_;
  Eigen::VectorXd switch_time_;  ///< derivatives of the time of `switch_`; or empty
  State<double> motion_, motion_rates_;
  const bool is_identity_;  ///< whether control_directions() are the parameters
  bool with_gradient_ = false, with_root_ = false;
};

}  // namespace codesign
