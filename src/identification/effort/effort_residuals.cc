// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/effort_residuals.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/arrays.h"
#include "recordings/measured_motion.h"

namespace codesign {
namespace {

const JointMotion& motion_of(const MeasuredMotion& recording, const std::string& joint) {
  return *std::find_if(recording.joints.begin(), recording.joints.end(),
                       [&](const JointMotion& motion) { return motion.joint == joint; });
}

std::vector<std::string> names_of(const std::vector<MeasuredJoint>& joints) {
  std::vector<std::string> names;
  names.reserve(joints.size());
  for (const MeasuredJoint& joint : joints) names.push_back(joint.name);
  return names;
}

}  // namespace

EffortResiduals::EffortResiduals(const CompiledSystem& system, const FitVariables& variables,
                                 std::vector<MeasuredJoint> joints,
                                 std::vector<MeasuredMotion> recordings,
                                 const FilterOptions& filter, int threads,
                                 std::vector<SignalDescription> signals)
    : variables_(variables),
      recordings_(std::move(recordings)),
      filter_(filter),
      signals_(std::move(signals)) {
  const std::vector<std::string> names = names_of(joints);
  std::vector<bool> with_effort;
  with_effort.reserve(joints.size());
  for (const MeasuredJoint& joint : joints) with_effort.push_back(joint.with_effort);
  bounds_ = std::make_unique<RestBounds>(bounds_of(samples_of_all(names), joints));
  model_ = std::make_unique<EffortModel>(system, std::move(joints), bounds_->samples(), threads,
                                         signals_);
  refuse_bounds_of_projected();
  const std::vector<int>& drives = model_->driven().drives;
  for (std::size_t k = 0; k < drives.size(); ++k) {
    const auto joint = to_index(drives[k]);
    if (!with_effort[joint]) continue;
    outputs_.push_back(names[joint]);
    drives_.push_back(static_cast<int>(k));
  }
  for (std::size_t k = 0; k < signals_.size(); ++k) {
    outputs_.push_back(signals_[k].text);
    drives_.push_back(static_cast<int>(drives.size() + k));
  }
  for (const MeasuredMotion& recording : recordings_) {
    std::vector<double> times;
    for (Eigen::Index k = 0; k < recording.times.count; ++k) times.push_back(recording.times.at(k));
    efforts_.emplace_back();
    for (std::size_t output = 0; output < outputs_.size(); ++output) {
      const Eigen::VectorXd& effort = recorded_of(recording, output);
      efforts_.back().emplace_back(times, std::vector<double>(effort.begin(), effort.end()));
    }
    lengths_.push_back(recording.fitted());
    rows_ += recording.fitted();
  }
  record();
  count();
}

const Eigen::VectorXd& EffortResiduals::recorded_of(const MeasuredMotion& recording,
                                                    std::size_t output) const {
  const std::size_t efforts = outputs_.size() - signals_.size();
  return output < efforts ? motion_of(recording, outputs_[output]).effort
                          : recording.signals[output - efforts];
}

// Filters need all samples; without filters, only the fitted samples are computed.
MotionSamples EffortResiduals::samples_of_all(const std::vector<std::string>& joints) {
  MotionSamples samples;
  begins_.assign(1, 0);
  for (const MeasuredMotion& recording : recordings_)
    begins_.push_back(begins_.back() +
                      (filter_.residual_cutoff > 0.0 ? recording.times.count : recording.fitted()));
  samples.begins.assign(begins_.begin(), begins_.end() - 1);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto is_fitted = [&](const MeasuredMotion& recording) {
      return variables_.start_column(recording.element, joints[j]) >= 0;
    };
    if (std::any_of(recordings_.begin(), recordings_.end(), is_fitted))
      samples.shifted.push_back(static_cast<int>(j));
  }
  for (const MeasuredMotion& recording : recordings_) {
    start_columns_.emplace_back();
    for (int j : samples.shifted)
      start_columns_.back().push_back(
          variables_.start_column(recording.element, joints[to_index(j)]));
  }
  for (Eigen::MatrixXd* rows : {&samples.position, &samples.velocity, &samples.acceleration})
    rows->resize(to_signed(joints.size()), begins_.back());
  for (std::size_t r = 0; r < recordings_.size(); ++r) {
    const MeasuredMotion& recording = recordings_[r];
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const JointMotion& motion = motion_of(recording, joints[j]);
      const auto row = to_signed(j);
      for (Eigen::Index k = begins_[r]; k < begins_[r + 1]; ++k) {
        const Eigen::Index at = filter_.residual_cutoff > 0.0
                                    ? k - begins_[r]
                                    : recording.first + (k - begins_[r]) * recording.every;
        samples.position(row, k) = motion.position[at];
        samples.velocity(row, k) = motion.velocity[at];
        samples.acceleration(row, k) = motion.acceleration[at];
      }
    }
    for (Eigen::Index k = begins_[r]; k < begins_[r + 1]; ++k)
      samples.times.push_back(time(r, k - begins_[r]));
  }
  return samples;
}

RestBounds EffortResiduals::bounds_of(const MotionSamples& samples,
                                      const std::vector<MeasuredJoint>& joints) const {
  Eigen::MatrixXd speeds = Eigen::MatrixXd::Zero(samples.velocity.rows(), samples.velocity.cols());
  for (std::size_t r = 0; r < recordings_.size(); ++r)
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const JointMotion& motion = motion_of(recordings_[r], joints[j].name);
      if (!motion.has_bounds || !joints[j].with_effort) continue;
      for (Eigen::Index k = begins_[r]; k < begins_[r + 1]; ++k)
        if (std::abs(samples.velocity(to_signed(j), k)) < motion.least_speed)
          speeds(to_signed(j), k) = motion.least_speed;
    }
  return RestBounds(samples, speeds);
}

// The projection would change the speed at which a joint just moves.
void EffortResiduals::refuse_bounds_of_projected() const {
  if (model_->driven().surplus.empty()) return;
  for (const MeasuredMotion& recording : recordings_)
    for (const JointMotion& motion : recording.joints)
      if (motion.has_bounds && motion.least_speed > 0.0)
        throw InputError(
            {recording.where, recording.element + ".mask.rest",
             "the recording has more joints than degrees of freedom: no joint moves alone",
             "bounds", "rest: leave_out, or recordings of independent joints"});
}

std::vector<double> EffortResiduals::times() const {
  std::vector<double> times;
  for (const MeasuredMotion& motion : recordings_)
    for (Eigen::Index k = 0; k < motion.fitted(); ++k)
      times.push_back(motion.times.at(motion.first + k * motion.every));
  return times;
}

double EffortResiduals::time(std::size_t recording, Eigen::Index sample) const {
  const MeasuredMotion& motion = recordings_[recording];
  return motion.times.at(filter_.residual_cutoff > 0.0 ? sample
                                                       : motion.first + sample * motion.every);
}

void EffortResiduals::fill(std::size_t recording, std::size_t output, const Eigen::VectorXd& x,
                           bool with_slopes,
                           const std::function<Eigen::Index(Eigen::Index)>& at_sample,
                           Eigen::MatrixXd* columns) const {
  const EffortSensor sensor = variables_.sensor(outputs_[output], x);
  const FitVariables::SensorColumns at = variables_.columns(outputs_[output]);
  const Eigen::Index drives = model_efforts_.rows(), drive = drives_[output],
                     count = begins_[recording + 1] - begins_[recording];
  columns->setZero(count, with_slopes ? 1 + x.size() : 1);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index sample = at_sample(begins_[recording] + k);
    const EffortResidual residual = effort_residual(
        sensor, efforts_[recording][output], time(recording, k), model_efforts_(drive, sample));
    (*columns)(k, 0) = residual.value;
    if (!with_slopes) continue;
    columns->row(k).segment(1, variables_.tuned()) =
        residual.by_effort * model_jacobian_.row(sample * drives + drive).head(variables_.tuned());
    if (at.scale >= 0) (*columns)(k, 1 + at.scale) = residual.by_scale;
    if (at.delay >= 0) (*columns)(k, 1 + at.delay) = residual.by_delay;
    if (at.offset >= 0) (*columns)(k, 1 + at.offset) = residual.by_effort;
    for (std::size_t s = 0; s < start_columns_[recording].size(); ++s)
      if (const int start = start_columns_[recording][s]; start >= 0)
        (*columns)(k, 1 + start) =
            residual.by_effort *
            model_jacobian_(sample * drives + drive, variables_.tuned() + to_signed(s));
  }
}

Eigen::MatrixXd EffortResiduals::fitted(std::size_t recording, Eigen::MatrixXd* columns) const {
  const MeasuredMotion& motion = recordings_[recording];
  if (!(filter_.residual_cutoff > 0.0)) return *columns;
  ZeroPhaseFilter::Workspace workspace;
  ZeroPhaseFilter(filter_.order, filter_.residual_cutoff, motion.times.rate())
      .apply_to_columns(*columns, &workspace);
  Eigen::MatrixXd kept(motion.fitted(), columns->cols());
  for (Eigen::Index k = 0; k < kept.rows(); ++k)
    kept.row(k) = columns->row(motion.first + k * motion.every);
  return kept;
}

bool EffortResiduals::is_bounded(std::size_t recording, std::size_t output) const {
  if (output >= outputs_.size() - signals_.size()) return false;
  const JointMotion& joint = motion_of(recordings_[recording], outputs_[output]);
  return joint.has_bounds && joint.least_speed > 0.0;
}

// Both bounds pass the filter before the nearer one is taken, as the recorded effort does.
Eigen::MatrixXd EffortResiduals::rows_of(std::size_t recording, std::size_t output,
                                         const Eigen::VectorXd& x, bool with_slopes) const {
  Eigen::MatrixXd columns;
  if (!is_bounded(recording, output)) {
    fill(
        recording, output, x, with_slopes,
        [this](Eigen::Index sample) { return bounds_->place(sample); }, &columns);
    return counted_of(recording, output, &columns);
  }
  const Eigen::Index joint = model_->driven().drives[to_index(drives_[output])];
  const auto bound = [&](bool is_forward) {
    fill(
        recording, output, x, with_slopes,
        [&](Eigen::Index sample) { return bounds_->bound(joint, sample, is_forward); }, &columns);
    return fitted(recording, &columns);
  };
  Eigen::MatrixXd kept = bound(false);
  take_nearer_bound(bound(true), &kept);
  return kept;
}

bool EffortResiduals::counts(std::size_t recording, std::size_t output, Eigen::Index sample) const {
  if (output >= outputs_.size() - signals_.size()) return true;
  const MeasuredMotion& motion = recordings_[recording];
  const JointMotion& joint = motion_of(motion, outputs_[output]);
  const Eigen::Index at =
      filter_.residual_cutoff > 0.0 ? sample : motion.first + sample * motion.every;
  return !(std::abs(joint.velocity[at]) < joint.least_speed);
}

Eigen::MatrixXd EffortResiduals::counted_of(std::size_t recording, std::size_t output,
                                            Eigen::MatrixXd* columns) const {
  if (counted_.size() == 0) return fitted(recording, columns);
  for (Eigen::Index k = 0; k < columns->rows(); ++k)
    if (!counts(recording, output, k)) columns->row(k).setZero();
  Eigen::MatrixXd kept = fitted(recording, columns);
  Eigen::Index row = 0;
  for (std::size_t r = 0; r < recording; ++r) row += lengths_[r];
  for (Eigen::Index k = 0; k < kept.rows(); ++k)
    if (counted_(row + k, to_signed(output)) == 0.0) kept.row(k).setZero();
  return kept;
}

void EffortResiduals::count() {
  const auto has_mask = [](const MeasuredMotion& motion) {
    return std::any_of(motion.joints.begin(), motion.joints.end(),
                       [](const JointMotion& joint) { return joint.least_speed > 0.0; });
  };
  if (std::none_of(recordings_.begin(), recordings_.end(), has_mask)) return;
  counted_ = Eigen::MatrixXd::Ones(rows_, to_signed(outputs_.size()));
  Eigen::Index row = 0;
  for (std::size_t r = 0; r < recordings_.size(); ++r) {
    const MeasuredMotion& motion = recordings_[r];
    for (Eigen::Index k = 0; k < lengths_[r]; ++k, ++row)
      for (std::size_t o = 0; o < outputs_.size(); ++o)
        if (!counts(r, o, filter_.residual_cutoff > 0.0 ? motion.first + k * motion.every : k))
          counted_(row, to_signed(o)) = 0.0;
  }
}

void EffortResiduals::record() {
  recorded_.resize(rows_, to_signed(outputs_.size()));
  Eigen::Index row = 0;
  for (std::size_t r = 0; r < recordings_.size(); ++r) {
    for (std::size_t o = 0; o < outputs_.size(); ++o) {
      Eigen::MatrixXd columns(begins_[r + 1] - begins_[r], 1);
      for (Eigen::Index k = 0; k < columns.rows(); ++k)
        columns(k, 0) = efforts_[r][o].at(time(r, k)).value;
      columns *= variables_.sensor(outputs_[o], variables_.start()).start_scale;
      recorded_.col(to_signed(o)).segment(row, lengths_[r]) = fitted(r, &columns).col(0);
    }
    row += lengths_[r];
  }
}

Eigen::MatrixXd EffortResiduals::shifts(const Eigen::VectorXd& x) const {
  Eigen::MatrixXd shifts =
      Eigen::MatrixXd::Zero(start_columns_.empty() ? 0 : to_signed(start_columns_.front().size()),
                            to_signed(start_columns_.size()));
  for (Eigen::Index r = 0; r < shifts.cols(); ++r)
    for (Eigen::Index s = 0; s < shifts.rows(); ++s)
      if (const int column = start_columns_[to_index(r)][to_index(s)]; column >= 0)
        shifts(s, r) = x[column] - variables_.start()[column];
  return shifts;
}

Status EffortResiduals::begin(const Eigen::VectorXd& x) {
  model_->shift(shifts(x));
  Status status = model_->begin(variables_.parameters(x));
  if (status.ok()) begun_ = x;
  return status;
}

Status EffortResiduals::place(const Eigen::VectorXd& x) {
  // [rad or m]: within this distance the samples still find their solutions.
  constexpr double kNear = 0.1;
  const Eigen::MatrixXd here = shifts(x);
  if (here.size() == 0) return {};
  model_->shift(here);
  if (begun_.size() > 0 && (here - shifts(begun_)).cwiseAbs().maxCoeff() <= kNear) return {};
  const Eigen::VectorXd before = begun_;
  Status status = begin(x);
  if (!status.ok() && status.code != StatusCode::kCancelled && before.size() > 0)
    if (Status back = begin(before); !back.ok()) return back;
  return status;
}

void EffortResiduals::clear_starts_without_effect(Eigen::MatrixXd* jacobian) const {
  // Relative to the recorded efforts, for a change of the start by 1 rad or 1 m.
  constexpr double kLeastEffect = 1e-10;
  for (const std::vector<int>& recording : start_columns_)
    for (int column : recording)
      if (column >= 0 && jacobian->col(column).norm() <= kLeastEffect * recorded_.norm())
        jacobian->col(column).setZero();
}

Status EffortResiduals::evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals,
                                 Eigen::MatrixXd* jacobian) {
  if (Status placed = place(x); !placed.ok()) return placed;
  Status status = model_->evaluate(variables_.parameters(x), &model_efforts_,
                                   jacobian ? &model_jacobian_ : nullptr);
  if (!status.ok()) return status;
  const auto outputs = to_signed(outputs_.size());
  residuals->resize(rows_, outputs);
  if (jacobian) jacobian->resize(rows_ * outputs, x.size());
  Eigen::Index row = 0;
  for (std::size_t r = 0; r < recordings_.size(); ++r) {
    for (std::size_t o = 0; o < outputs_.size(); ++o) {
      const auto output = to_signed(o);
      const Eigen::MatrixXd kept = rows_of(r, o, x, jacobian != nullptr);
      residuals->col(output).segment(row, lengths_[r]) = kept.col(0);
      if (jacobian)
        jacobian->middleRows(output * rows_ + row, lengths_[r]) = kept.rightCols(x.size());
    }
    row += lengths_[r];
  }
  if (jacobian) clear_starts_without_effect(jacobian);
  return {};
}

void EffortResiduals::motion_of_outputs(Eigen::MatrixXd* velocity,
                                        Eigen::MatrixXd* acceleration) const {
  velocity->resize(begins_.back(), to_signed(outputs_.size()));
  acceleration->resizeLike(*velocity);
  for (Eigen::Index k = 0; k < begins_.back(); ++k)
    for (std::size_t o = 0; o < outputs_.size(); ++o) {
      (*velocity)(k, to_signed(o)) = model_->velocity()(drives_[o], bounds_->place(k));
      (*acceleration)(k, to_signed(o)) = model_->acceleration()(drives_[o], bounds_->place(k));
    }
}

// The slope of the computed effort serves as a column without noise: it is independent of the noise
// in the recorded effort.
std::vector<DelaySignal> EffortResiduals::delay_signals(const Eigen::VectorXd& x) {
  constexpr double kLeastShare = 0.01;
  std::vector<DelaySignal> signals;
  Eigen::MatrixXd residuals;
  for (std::size_t o = 0; o < outputs_.size(); ++o)
    if (const int column = variables_.columns(outputs_[o]).delay; column >= 0)
      signals.push_back({outputs_[o], column, to_signed(o), 1.0, {}});
  if (signals.empty() || !evaluate(x, &residuals, nullptr).ok()) return signals;
  for (DelaySignal& signal : signals) {
    const auto o =
        to_index(std::find(outputs_.begin(), outputs_.end(), signal.joint) - outputs_.begin());
    const EffortSensor sensor = variables_.sensor(signal.joint, x);
    double both = 0.0, slopes = 0.0;
    Eigen::Index row = 0;
    signal.slopes.resize(rows_);
    for (std::size_t r = 0; r < recordings_.size(); ++r) {
      const MeasuredMotion& motion = recordings_[r];
      const double step =
          motion.times.step * static_cast<double>(filter_.residual_cutoff > 0.0 ? 1 : motion.every);
      Eigen::MatrixXd columns(begins_[r + 1] - begins_[r], 2);
      for (Eigen::Index k = 0; k < columns.rows(); ++k) {
        const double effort = model_efforts_(drives_[o], bounds_->place(begins_[r] + k));
        const EffortResidual residual = effort_residual(sensor, efforts_[r][o], time(r, k), effort);
        columns(k, 0) = residual.by_effort * (effort + sensor.offset);
        columns(k, 1) = -residual.by_delay;
      }
      columns.col(0) = derivative(Eigen::VectorXd(columns.col(0)), step);
      const Eigen::MatrixXd kept = counted_of(r, o, &columns);
      both += kept.col(0).dot(kept.col(1));
      slopes += kept.col(1).squaredNorm();
      signal.slopes.segment(row, lengths_[r]) = -kept.col(0);
      row += lengths_[r];
    }
    if (slopes > 0.0) signal.share = std::clamp(both / slopes, kLeastShare, 1.0);
  }
  return signals;
}

}  // namespace codesign
