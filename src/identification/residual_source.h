// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_IDENTIFICATION_RESIDUAL_SOURCE_H_
#define MECHANISM_CODESIGN_IDENTIFICATION_RESIDUAL_SOURCE_H_

#include <Eigen/Core>
#include <atomic>
#include <string>
#include <vector>

#include "description/identification.h"
#include "mechanism_codesign/status.h"
#include "statistics/long_run.h"

namespace codesign {

/// Residuals of a fit and their derivatives, whatever they compare.
class ResidualSource {
 public:
  virtual ~ResidualSource() = default;
  /// Names of the columns of the residuals.
  virtual const std::vector<std::string>& outputs() const = 0;
  /// Residuals of each recording; their sum is the number of rows.
  virtual const SeriesLengths& lengths() const = 0;
  /// @param residuals resized to rows x outputs. @param jacobian may be null; else resized to (rows outputs) x size of x, the rows of
  /// output 0 first. @return a failure at this point, kCancelled, or ok
  virtual Status evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals, Eigen::MatrixXd* jacobian) = 0;

  /// How the fit counts residuals from now on. Only a source that has unknowns of its own, which it fits, needs to know, doc/theory.md
  /// (42). Without a Jacobian its residuals are those of its best unknowns at x. With one, its unknowns have taken one step, from the best
  /// point since the last call of count_by() towards x, and the Jacobian is that of residuals whose unknowns follow x.
  /// @param spreads positive, one per output
  virtual void count_by(const Eigen::VectorXd& spreads, const LossOptions& loss);
  /// How many unknowns of its own it has: they take degrees of freedom from the residuals.
  virtual Eigen::Index own_unknowns() const { return 0; }
  /// By how much its best unknowns would lower the sum of rho(r / s) at the last point evaluated with a Jacobian, to first order.
  virtual double own_promise() const { return 0.0; }
};

inline void ResidualSource::count_by(const Eigen::VectorXd& /*spreads*/, const LossOptions& /*loss*/) {}

/// How much of the slope of a recorded effort is signal, for a delay that was fitted by it.
struct DelaySignal {
  std::string joint;
  Eigen::Index column = 0;  ///< of the delay in x
  Eigen::Index output = 0;  ///< of the residuals
  double share = 1.0;       ///< in (0, 1], doc/theory.md (33a)
  Eigen::VectorXd slopes;   ///< the column for the rows of its output without the noise of the recorded effort; empty: not known
};

/// Residuals of recordings, as an identification needs them.
class RecordingResiduals : public ResidualSource {
 public:
  /// Prepares for the neighbourhood of a design; to be called first.
  virtual Status begin(const Eigen::VectorXd& x) = 0;
  /// Once set, evaluations end soon with kCancelled; nullptr: never.
  virtual void obey(const std::atomic<bool>* cancel) = 0;
  virtual Eigen::Index rows() const = 0;
  /// Times of the rows [s], each from the clock of its recording.
  virtual std::vector<double> times() const = 0;
  /// What was recorded of the outputs; rows() x outputs. Residuals are computed minus recorded.
  virtual const Eigen::MatrixXd& recorded() const = 0;
  /// One entry per fitted delay whose column of the Jacobian is the slope of a recorded effort. @param x at which residuals can be computed
  virtual std::vector<DelaySignal> delay_signals(const Eigen::VectorXd& x);
};

inline std::vector<DelaySignal> RecordingResiduals::delay_signals(const Eigen::VectorXd& /*x*/) { return {}; }

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_IDENTIFICATION_RESIDUAL_SOURCE_H_
