// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "identification/fit_variables.h"
#include "identification/residual_source.h"

namespace codesign {

/// The residuals of recordings with different values of some parameters, one part for each set of values: rows of the first part first,
/// with the same outputs and the same x.
class StackedResiduals final : public RecordingResiduals {
 public:
  struct Part {
    std::unique_ptr<const FitVariables> variables;  ///< of the residuals
    std::unique_ptr<RecordingResiduals> residuals;
  };
  /// @param parts at least one, all with the same outputs
  explicit StackedResiduals(std::vector<Part> parts);

  const std::vector<std::string>& outputs() const override { return parts_.front().residuals->outputs(); }
  const SeriesLengths& lengths() const override { return lengths_; }
  Eigen::Index rows() const override { return recorded_.rows(); }
  std::vector<double> times() const override;
  const Eigen::MatrixXd& recorded() const override { return recorded_; }
  Status begin(const Eigen::VectorXd& x) override;
  Status evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals, Eigen::MatrixXd* jacobian) override;
  void obey(const std::atomic<bool>* cancel) override;
  void count_by(const Eigen::VectorXd& spreads, const LossOptions& loss) override;
  Eigen::Index own_unknowns() const override;
  double own_promise() const override;
  std::vector<DelaySignal> delay_signals(const Eigen::VectorXd& x) override;

 private:
  std::vector<Part> parts_;
  SeriesLengths lengths_;
  Eigen::MatrixXd recorded_;
};

}  // namespace codesign
