// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "linear/linear_study.h"
#include "math/scalar.h"

namespace codesign {

/// How a posture at rest, with reactions and the states of its controllers, moves with the design:
/// the implicit function theorem for G = 0, Phi = 0 with v = 0, v' = 0, s' = 0 and sampled
/// controllers whose samples change nothing, theory (70a). Not thread-safe.
class RestDerivatives {
 public:
  /// @param system of study.study; both must outlive this.
  RestDerivatives(const CompiledSystem& system, const LinearStudy& study);

  /// Changes of the state along a direction: z of the reactions alone.
  struct Change {
    Eigen::VectorXd q, s, z;
  };
  /// @param rest the state, with all that is at rest. @param design the parameters before the
  /// inputs. @returns the changes by each tuned parameter, then along directions that nothing
  /// determines, as the position of a cart whose speed is controlled.
  std::vector<Change> at(const State<double>& rest, const std::vector<double>& design);
  /// How many of the changes are those by parameters.
  Eigen::Index parameters() const { return static_cast<Eigen::Index>(tuned_); }

 private:
  static constexpr int kLanes = 8;
  using Number = Lanes<kLanes>;

  void evaluate(const State<double>& rest, const std::vector<double>& design, Eigen::Index first,
                Eigen::MatrixXd* rows);
  void add_samples(VectorX<Number>* rows);

  const CompiledSystem& system_;
  const LinearStudy& study_;
  const std::size_t tuned_;
  const Eigen::Index unknowns_;  ///< q, s, reactions
  std::vector<bool> dropped_;    ///< per row of Phi
  Equations<Number> lanes_;
  State<Number> state_, sampled_;
};

}  // namespace codesign
