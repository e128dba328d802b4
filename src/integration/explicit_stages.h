// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "integration/step_method.h"

namespace codesign {

/// The stages of an explicit pair, doc/theory.md (15b), each of which solves G = 0 for z at its q,
/// v and s. The increments are u_x = h (v, sigma), u_v = h a, u_psi = h g and u_z = z_i - z, where
/// z belongs to the beginning of the step. The last stage is at the end of the step; without
/// constraints it is the next step's first one.
template <class T>
class ExplicitStages : public StepMethod<T> {
 public:
  /// G_z of a stage as the program that solved it has factored it.
  struct StageFactor {
    const MassFactor* pattern = nullptr;  ///< null if the stage was solved with a matrix
    std::vector<T> values;
  };

  /// @param memory must outlive this.
  explicit ExplicitStages(StepMemory<T>* memory) : m_(*memory), factors_(memory->stages.size()) {
    first_.resize(m_.layout);
    estimate_.setZero(m_.at.size());
  }

  void begin() override;
  void forget() override { has_first_ = false; }
  /// Only where no expression gives the accelerations.
  bool needs_matrix() override;
  bool attempt() override;
  const VectorX<T>& estimate() const override { return estimate_; }
  /// With its own estimate the pair's error was up to ten times that of rodas4 at the same
  /// tolerance, doc/decisions/0084-explicit-pair.md.
  double caution() const override { return 5.0; }
  void finish(bool is_last) override;
  void interpolate_z(double theta, const State<T>& from, State<T>* state) const override;
  void interpolate_z_rates(double theta, State<T>* rates) const override;

  /// Solves G = 0 for the z of any state, beginning with the z that it has. False if that fails.
  bool solve_at(State<T>* at) { return solve_rates(at, &aside_g_, &aside_factor_); }
  /// G_z at stage i of the last attempt. If it has no pattern, factor_stage() factors it for
  /// StepMemory::derivatives and stage_matrix, and returns false if it is singular.
  const StageFactor& stage_factor(std::size_t i) const { return factors_[i]; }
  bool factor_stage(std::size_t i);

 private:
  /// Solves G = 0 for the z of a state, beginning with the z that it has. @param g integrand there.
  bool solve_rates(State<T>* at, T* g, StageFactor* factor);
  void take_rates(std::size_t i, const T& g);

  StepMemory<T>& m_;
  std::vector<StageFactor> factors_;
  StageFactor first_factor_;  ///< of first_
  StageFactor aside_factor_;  ///< of solve_at()
  State<T> first_;            ///< the first stage of the next attempt, if has_first_
  T first_g_{0.0}, last_g_{0.0}, aside_g_{0.0};
  bool has_first_ = false;
  VectorX<T> estimate_;
};

}  // namespace codesign
