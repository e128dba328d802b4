// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "description/identification.h"
#include "identification/fit/fit_variables.h"
#include "math/dense.h"
#include "mechanism_codesign/status.h"
#include "statistics/time_series.h"

namespace codesign {

/// The contribution of a residual to the cost, and its weight in the normal equations.
struct LossValue {
  double value = 0.0;   ///< rho(u)
  double weight = 1.0;  ///< rho'(u) / (2 u), 1 for a sum of squares
};

/// The loss of a residual and its weight. @param u a residual divided by the spread of its output's
/// residuals
inline LossValue loss_of(const LossOptions& options, double u) {
  const LossLaw& law = *options.kind;
  return {weighted_loss(law, 1.0, LossValues<double>{u, 0.0, options.scale}),
          law.weight(u, options.scale)};
}

/// Residuals of a fit and their derivatives.
class ResidualSource {
 public:
  virtual ~ResidualSource() = default;
  /// Names of the columns of the residuals.
  virtual const std::vector<std::string>& outputs() const = 0;
  /// Number of residuals of each recording; the sum is the number of rows.
  virtual const SeriesLengths& lengths() const = 0;
  /// @param residuals resized to rows x outputs. @param jacobian may be null; else resized to (rows
  /// outputs) x size of x, the rows of output 0 first. @return a failure at this point, kCancelled,
  /// or ok
  virtual Status evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals,
                          Eigen::MatrixXd* jacobian) = 0;

  /// Sets spreads and loss with which the fit counts residuals from now on. Only a source that fits
  /// unknowns of its own uses them, doc/theory.md (42). Without a Jacobian, such a source evaluates
  /// residuals at its best unknowns for x. With a Jacobian, its unknowns take one step, from the
  /// best point since the last call of count_by() towards x, and the Jacobian includes that the
  /// unknowns follow x.
  /// @param spreads positive, one per output
  virtual void count_by(const Eigen::VectorXd& spreads, const LossOptions& loss);
  /// Number of unknowns of its own; they take degrees of freedom from the residuals.
  virtual Eigen::Index own_unknowns() const { return 0; }
  /// Number of residuals of each piece with unknowns of its own, in the order of the rows; pieces
  /// do not cross from one recording to the next. lengths() without such unknowns.
  virtual const SeriesLengths& pieces() const { return lengths(); }
  /// One for each residual that counts, zero for others, rows x outputs; empty: all count.
  /// Residuals that do not count are zero, and so are their derivatives; but for a joint that rests
  /// with an effort outside of its bounds.
  virtual Eigen::MatrixXd counted() const { return {}; }
  /// Decrease of the sum of rho(r / s) by the best unknowns at the last point evaluated with a
  /// Jacobian, to first order.
  virtual double inner_decrease() const { return 0.0; }
};

inline void ResidualSource::count_by(const Eigen::VectorXd& /*spreads*/,
                                     const LossOptions& /*loss*/) {}

/// The share of signal in the slope of a recorded effort, for a fitted delay whose derivative is
/// this slope.
struct DelaySignal {
  std::string joint;
  Eigen::Index column = 0;  ///< index of the delay in x
  Eigen::Index output = 0;  ///< index of the output
  double share = 1.0;       ///< in (0, 1], doc/theory.md (33a)
  /// rows of the output in the delay's column of the Jacobian, without the recorded effort's noise;
  /// empty: not known
  Eigen::VectorXd slopes;
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
  /// Number of outputs that are recorded signals; they stand behind the others.
  virtual std::size_t signals() const { return 0; }
  /// The part of recorded() that says something about x: without its mean; without what unknowns of
  /// the source's own fit for any x. Zero where residuals do not count.
  virtual Eigen::MatrixXd variation() const;
  /// Returns one entry per fitted delay whose column of the Jacobian is the slope of a recorded
  /// effort. @param x a point at which residuals can be computed
  virtual std::vector<DelaySignal> delay_signals(const Eigen::VectorXd& x);
};

inline Eigen::MatrixXd RecordingResiduals::variation() const {
  const Eigen::MatrixXd count = counted();
  if (count.size() == 0) return about_mean_of(recorded());
  const Eigen::RowVectorXd means =
      recorded().cwiseProduct(count).colwise().sum().cwiseQuotient(count.colwise().sum());
  return (recorded().rowwise() - means).cwiseProduct(count);
}

inline std::vector<DelaySignal> RecordingResiduals::delay_signals(const Eigen::VectorXd& /*x*/) {
  return {};
}

/// The residuals of recordings with different values of some parameters, one part for each set of
/// values: rows of the first part first, with the same outputs and the same x.
class StackedResiduals final : public RecordingResiduals {
 public:
  struct Part {
    std::unique_ptr<const FitVariables> variables;  ///< of the residuals
    std::unique_ptr<RecordingResiduals> residuals;
  };
  /// @param parts at least one, all with the same outputs
  explicit StackedResiduals(std::vector<Part> parts);

  const std::vector<std::string>& outputs() const override {
    return parts_.front().residuals->outputs();
  }
  const SeriesLengths& lengths() const override { return lengths_; }
  const SeriesLengths& pieces() const override { return pieces_; }
  Eigen::Index rows() const override { return recorded_.rows(); }
  std::vector<double> times() const override;
  const Eigen::MatrixXd& recorded() const override { return recorded_; }
  Eigen::MatrixXd variation() const override;
  Status begin(const Eigen::VectorXd& x) override;
  Status evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals,
                  Eigen::MatrixXd* jacobian) override;
  void obey(const std::atomic<bool>* cancel) override;
  void count_by(const Eigen::VectorXd& spreads, const LossOptions& loss) override;
  Eigen::Index own_unknowns() const override;
  Eigen::MatrixXd counted() const override;
  std::size_t signals() const override { return parts_.front().residuals->signals(); }
  double inner_decrease() const override;
  std::vector<DelaySignal> delay_signals(const Eigen::VectorXd& x) override;

 private:
  std::vector<Part> parts_;
  SeriesLengths lengths_, pieces_;
  Eigen::MatrixXd recorded_;
};

}  // namespace codesign
