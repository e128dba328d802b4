// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "linear/linear_model.h"
#include "linear/linear_motion.h"
#include "linear/period_map.h"
#include "linear/rest_derivatives.h"
#include "linear/sample_laws.h"
#include "linear/sampled_motion.h"

namespace codesign {

/// The derivatives of a linearization about rest, and of its loops, by the tuned parameters, theory
/// (70): through the equations' derivatives and through the posture. What is exact in the
/// equations is exact here: the derivatives are recorded ones at a complex step. Not thread-safe.
class LinearDerivatives {
 public:
  /// @param of its system must outlive this; at rest. Designs may differ from its parameters, but
  /// not in which integrals have a gain of zero.
  explicit LinearDerivatives(const LinearCase& of);
  ~LinearDerivatives();

  /// The imaginary part of a derivative of 1.
  static constexpr double kStep = ComplexSpace::kStep;

  /// Takes a design at rest. @param design all named parameters. @param state positions. @param
  /// integrals the state of each controller's integral. Statuses: those of LinearMotion.
  Status take(const std::vector<double>& design, const State<double>& state,
              const std::vector<double>& integrals);

  /// One per tuned parameter, then one per direction that the posture does not determine: along
  /// these no number may change.
  std::size_t directions() const { return changes_.size(); }
  std::size_t parameters() const { return static_cast<std::size_t>(rest_.parameters()); }
  double period() const { return pattern_.period; }
  /// The closed loops: of one period if a controller is sampled. Only A.
  ComplexSpace closed(std::size_t direction);
  /// From an effort beside the output of a controller to that output, as ControllerLoop has them.
  ComplexSpace loop(std::size_t controller, std::size_t direction);

 private:
  /// All of one direction.
  struct Space {
    std::size_t direction = 0;
    ComplexMotion motion;
    ComplexSpace flow;  ///< inputs: disturbances per controller that drives; outputs per controller
  };

  void step(std::size_t direction);
  void set_flow(const Eigen::MatrixXcd& A);
  Eigen::MatrixXcd directions_of(const Eigen::MatrixXcd& rows) const;
  void keep_states();
  Eigen::MatrixXcd kept_rows(const Eigen::MatrixXcd& jump) const;
  Eigen::Index disturbance_of(std::size_t controller) const;
  PeriodPieces pieces(Eigen::Index input);
  PeriodMap<std::complex<double>> period_map(int opened);
  LinearStudy study_of(const LinearCase& of);

  const std::size_t controllers_;
  SamplePattern pattern_;
  const LinearStudy study_;
  const CompiledSystem system_;
  LinearMotion motion_;
  RestDerivatives rest_;
  SampleLaws laws_;
  Equations<std::complex<double>> equations_;
  Linearization<std::complex<double>> derivatives_;
  std::vector<double> design_;
  std::vector<Eigen::Index> kept_;  ///< states of the loops
  std::vector<RestDerivatives::Change> changes_;
  std::unique_ptr<Space> space_;  ///< of the last direction
};

}  // namespace codesign
