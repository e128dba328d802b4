// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <string>
#include <vector>

#include "description/identification.h"
#include "mechanism_codesign/status.h"
#include "statistics/long_run.h"

namespace codesign {

/// Residuals of a fit and their derivatives.
class ResidualSource {
 public:
  virtual ~ResidualSource() = default;
  /// Names of the columns of the residuals.
  virtual const std::vector<std::string>& outputs() const = 0;
  /// Number of residuals of each recording; the sum is the number of rows.
  virtual const SeriesLengths& lengths() const = 0;
  /// @param residuals resized to rows x outputs. @param jacobian may be null; else resized to (rows outputs) x size of x, the rows of
  /// output 0 first. @return a failure at this point, kCancelled, or ok
  virtual Status evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals, Eigen::MatrixXd* jacobian) = 0;

  /// Sets spreads and loss with which the fit counts residuals from now on. Only a source that fits unknowns of its own uses them,
  /// doc/theory.md (42). Without a Jacobian, such a source evaluates residuals at its best unknowns for x. With a Jacobian, its unknowns
  /// take one step, from the best point since the last call of count_by() towards x, and the Jacobian includes that the unknowns follow x.
  /// @param spreads positive, one per output
  virtual void count_by(const Eigen::VectorXd& spreads, const LossOptions& loss);
  /// Number of unknowns of its own; they take degrees of freedom from the residuals.
  virtual Eigen::Index own_unknowns() const { return 0; }
  /// Decrease of the sum of rho(r / s) by the best unknowns at the last point evaluated with a Jacobian, to first order.
  virtual double own_promise() const { return 0.0; }
};

inline void ResidualSource::count_by(const Eigen::VectorXd& /*spreads*/, const LossOptions& /*loss*/) {}

/// The share of signal in the slope of a recorded effort, for a fitted delay whose derivative is this slope.
struct DelaySignal {
  std::string joint;
  Eigen::Index column = 0;  ///< index of the delay in x
  Eigen::Index output = 0;  ///< index of the output
  double share = 1.0;       ///< in (0, 1], doc/theory.md (33a)
  Eigen::VectorXd slopes;   ///< rows of the output in the delay's column of the Jacobian, without the recorded effort's noise; empty: not
                            ///< known
};

/// Residuals of recordings, as an identification needs them.
class RecordingResiduals : public ResidualSource {
 public:
  /// Prepares for the neighbourhood of a design. Call it first.
  virtual Status begin(const Eigen::VectorXd& x) = 0;
  /// Once set, evaluations end soon with kCancelled; nullptr: never.
  virtual void obey(const std::atomic<bool>* cancel) = 0;
  virtual Eigen::Index rows() const = 0;
  /// Times of the rows [s], each from the clock of its recording.
  virtual std::vector<double> times() const = 0;
  /// The recorded outputs; rows() x outputs. Residuals are computed minus recorded.
  virtual const Eigen::MatrixXd& recorded() const = 0;
  /// Returns one entry per fitted delay whose column of the Jacobian is the slope of a recorded effort. @param x a point at which residuals
  /// can be computed
  virtual std::vector<DelaySignal> delay_signals(const Eigen::VectorXd& x);
};

inline std::vector<DelaySignal> RecordingResiduals::delay_signals(const Eigen::VectorXd& /*x*/) { return {}; }

}  // namespace codesign
