// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "control/control_clock.h"
#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "linear/linear_study.h"

namespace codesign {

/// How the directions of x = (y, y', s) move coordinates, velocities and rates about a state, and
/// the state itself; imaginary parts are derivatives along a direction of the design.
struct ComplexMotion {
  State<std::complex<double>> state;
  std::vector<std::complex<double>> parameters;
  Eigen::MatrixXcd q, v, z;  ///< one column per entry of x; z the rates, as of Layout::columns()
  Eigen::Index motions = 0;
};

/// What the samples of controllers do to small motions about rest, with derivatives by the design,
/// theory (70b): each law is recorded as a signal of a study in which its controller is continuous.
/// Not thread-safe.
class SampleLaws {
 public:
  /// @param system of study.study; both must outlive this.
  SampleLaws(const CompiledSystem& system, const LinearStudy& study);
  ~SampleLaws();

  /// The states s after events at one instant by x: Layout::states rows.
  Eigen::MatrixXcd jump(const std::vector<ControlEvent>& events, const ComplexMotion& motion);

 private:
  struct Law;

  void load(int controller, const ComplexMotion& motion);
  Eigen::RowVectorXcd row_of(int controller, std::size_t watched, const ComplexMotion& motion,
                             const Eigen::MatrixXcd& s, std::complex<double>* value);
  void advance_filters(int controller, const ComplexMotion& motion, Eigen::MatrixXcd* s);
  void correct_estimates(const ControlEvent& event, const std::vector<std::complex<double>>& design,
                         const Eigen::RowVectorXcd& law, Eigen::MatrixXcd* s);
  void sample(const ControlEvent& event, const ComplexMotion& motion, Eigen::MatrixXcd* s);

  const CompiledSystem& system_;
  const LinearStudy& study_;
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<Law>> laws_;  ///< per controller; null: not sampled
};

}  // namespace codesign
