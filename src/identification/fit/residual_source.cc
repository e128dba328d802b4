// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/residual_source.h"

#include <utility>

namespace codesign {

StackedResiduals::StackedResiduals(std::vector<Part> parts) : parts_(std::move(parts)) {
  Eigen::Index rows = 0;
  for (const Part& part : parts_) {
    lengths_.insert(lengths_.end(), part.residuals->lengths().begin(),
                    part.residuals->lengths().end());
    pieces_.insert(pieces_.end(), part.residuals->pieces().begin(), part.residuals->pieces().end());
    rows += part.residuals->rows();
  }
  recorded_.resize(rows, parts_.front().residuals->recorded().cols());
  rows = 0;
  for (const Part& part : parts_) {
    recorded_.middleRows(rows, part.residuals->rows()) = part.residuals->recorded();
    rows += part.residuals->rows();
  }
}

std::vector<double> StackedResiduals::times() const {
  std::vector<double> times;
  for (const Part& part : parts_) {
    const std::vector<double> more = part.residuals->times();
    times.insert(times.end(), more.begin(), more.end());
  }
  return times;
}

Eigen::MatrixXd StackedResiduals::variation() const {
  if (own_unknowns() == 0) return RecordingResiduals::variation();
  Eigen::MatrixXd result(recorded_.rows(), recorded_.cols());
  Eigen::Index row = 0;
  for (const Part& part : parts_) {
    result.middleRows(row, part.residuals->rows()) = part.residuals->variation();
    row += part.residuals->rows();
  }
  return result;
}

Status StackedResiduals::begin(const Eigen::VectorXd& x) {
  for (const Part& part : parts_)
    if (Status status = part.residuals->begin(x); !status.ok()) return status;
  return {};
}

Status StackedResiduals::evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals,
                                  Eigen::MatrixXd* jacobian) {
  const Eigen::Index outputs = recorded_.cols();
  residuals->resize(rows(), outputs);
  if (jacobian) jacobian->resize(rows() * outputs, x.size());
  Eigen::MatrixXd values, slopes;
  Eigen::Index row = 0;
  for (const Part& part : parts_) {
    if (Status status = part.residuals->evaluate(x, &values, jacobian ? &slopes : nullptr);
        !status.ok())
      return status;
    const Eigen::Index count = values.rows();
    residuals->middleRows(row, count) = values;
    for (Eigen::Index k = 0; jacobian && k < outputs; ++k)
      jacobian->middleRows(k * rows() + row, count) = slopes.middleRows(k * count, count);
    row += count;
  }
  return {};
}

void StackedResiduals::obey(const std::atomic<bool>* cancel) {
  for (const Part& part : parts_) part.residuals->obey(cancel);
}

void StackedResiduals::count_by(const Eigen::VectorXd& spreads, const LossOptions& loss) {
  for (const Part& part : parts_) part.residuals->count_by(spreads, loss);
}

Eigen::Index StackedResiduals::own_unknowns() const {
  Eigen::Index sum = 0;
  for (const Part& part : parts_) sum += part.residuals->own_unknowns();
  return sum;
}

Eigen::MatrixXd StackedResiduals::counted() const {
  Eigen::MatrixXd result;
  Eigen::Index row = 0;
  for (const Part& part : parts_) {
    const Eigen::MatrixXd counted = part.residuals->counted();
    if (counted.size() > 0 && result.size() == 0)
      result = Eigen::MatrixXd::Ones(recorded_.rows(), recorded_.cols());
    if (counted.size() > 0) result.middleRows(row, counted.rows()) = counted;
    row += part.residuals->rows();
  }
  return result;
}

double StackedResiduals::inner_decrease() const {
  double sum = 0.0;
  for (const Part& part : parts_) sum += part.residuals->inner_decrease();
  return sum;
}

// All parts have the same sensors, and so the same signals in the same order; shares are means over
// the rows.
std::vector<DelaySignal> StackedResiduals::delay_signals(const Eigen::VectorXd& x) {
  std::vector<DelaySignal> signals;
  Eigen::Index row = 0;
  for (const Part& part : parts_) {
    const std::vector<DelaySignal> more = part.residuals->delay_signals(x);
    const Eigen::Index count = part.residuals->rows();
    if (row == 0) signals = more;
    for (std::size_t k = 0; k < signals.size(); ++k) {
      const double weight = static_cast<double>(count) / static_cast<double>(rows());
      signals[k].share = (row == 0 ? 0.0 : signals[k].share) + weight * more[k].share;
      if (row == 0) signals[k].slopes.setZero(more[k].slopes.size() > 0 ? rows() : 0);
      if (signals[k].slopes.size() > 0 && more[k].slopes.size() > 0)
        signals[k].slopes.segment(row, count) = more[k].slopes;
    }
    row += count;
  }
  return signals;
}

}  // namespace codesign
