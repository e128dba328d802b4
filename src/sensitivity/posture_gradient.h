// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "integration/posture_sequence.h"
#include "integration/watch_layout.h"
#include "sensitivity/gradient_engine.h"
#include "sensitivity/lane_directions.h"
#include "sensitivity/residual_rows.h"

namespace codesign {

/// The gradient of a study with postures, doc/theory.md (21f): each posture is the solution of its
/// own equations, so that its derivatives follow from the implicit function theorem there
/// (Assembly::extend()) and do not depend on the postures before.
class PostureGradient final : public GradientEngine {
 public:
  explicit PostureGradient(const CompiledSystem& system);

  Status start(const std::vector<double>& parameters, Derivatives derivatives) override;
  Status advance(double limit) override;
  const Integrator& integrator() const override { return sequence_; }
  double objective() override;
  void gradient(Eigen::VectorXd* gradient) override;
  void jacobian_root(Eigen::MatrixXd* root) override { residuals_.finish(sequence_.state(), root); }
  const Extremes& extremes() const override { return extremes_; }
  const Statistics& statistics() const override { return sequence_.statistics(); }
  Warnings warnings() const override { return sequence_.warnings(); }
  void obey(const std::atomic<bool>* cancel) override { sequence_.obey(cancel); }

 private:
  template <int N>
  struct Group {
    using Scalar = Lanes<N>;
    Group(const CompiledSystem& system, LaneRange<N> lanes) : range(lanes), equations(system) {}
    LaneRange<N> range;
    Equations<Scalar> equations;
    std::vector<Scalar> parameters;  ///< with the directions of `range`
    State<Scalar> state;             ///< the present posture
    ExtensionWorkspace<Scalar> extension;
    VectorX<Scalar> G, residuals;
  };

  Eigen::Index count() const { return to_signed(system_.study().tuned.size()); }
  Status look();
  void watch(std::size_t k);
  /// Calls function(group) -> a number with lanes for each group, and gathers its derivatives.
  template <class Function>
  Eigen::VectorXd derivatives(const Function& function);
  void differentiate_residuals(ObjectivePart part, Eigen::MatrixXd* rows);

  const CompiledSystem& system_;
  PostureSequence sequence_;
  LaneGroups<Group> groups_;
  const WatchLayout layout_;
  ResidualRows residuals_;
  Extremes extremes_;
  Eigen::VectorXd sum_;  ///< derivatives of psi so far
  bool with_gradient_ = false, with_root_ = false;
};

}  // namespace codesign
