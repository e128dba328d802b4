// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "identification/effort/compared_recordings.h"
#include "identification/effort/effort_model.h"
#include "identification/effort/rest_bounds.h"
#include "identification/fit/fit_variables.h"
#include "identification/fit/residual_source.h"
#include "recordings/measured_motion.h"
#include "recordings/zero_phase_filter.h"
#include "statistics/time_series.h"

namespace codesign {

/// Residuals of several recordings of one robot as functions of x: computed minus recorded efforts,
/// doc/theory.md (28c), then signals, at the samples to fit, and their exact derivatives. If
/// FilterOptions::residual_cutoff is set, both pass the same zero-phase filter. Samples at which a
/// joint is slower than its JointSamples::least_speed are zero before the filter and behind it, so
/// that the filter spreads nothing of what friction at rest does. With JointSamples::has_bounds
/// they are the distance from the efforts between which friction at rest is, zero within, (28d).
class EffortResiduals final : public RecordingResiduals {
 public:
  /// @param system, variables must outlive this. @param recordings all with the same joints.
  /// @param joints the joints of the recordings whose motion counts, as require_same_joints()
  /// returns them. @param signals of the recordings. @throws InputError as make_driven_system(),
  /// and for bounds at rest of more joints than there are degrees of freedom;
  /// whether enough samples count is for the caller to ask, as require_counted() does
  EffortResiduals(const CompiledSystem& system, const FitVariables& variables,
                  std::vector<MeasuredJoint> joints, std::vector<MeasuredMotion> recordings,
                  const FilterOptions& filter, int threads,
                  std::vector<SignalDescription> signals = {});

  /// The joints with a residual, one column each; then the signals.
  const std::vector<std::string>& outputs() const override { return outputs_; }
  /// Number of fitted samples of each recording.
  const SeriesLengths& lengths() const override { return lengths_; }
  Eigen::Index rows() const override { return rows_; }
  /// Fitted efforts as recorded, filtered like the residuals, times the scale at the start [N m or
  /// N]; rows() x outputs.
  std::vector<DelaySignal> delay_signals(const Eigen::VectorXd& x) override;
  const Eigen::MatrixXd& recorded() const override { return recorded_; }
  Eigen::MatrixXd counted() const override { return counted_; }
  std::size_t signals() const override { return signals_.size(); }
  /// Times of the rows [s], each from the clock of its recording.
  std::vector<double> times() const override;

  /// Follows the motion at a design. Call it first.
  Status begin(const Eigen::VectorXd& x) override;
  /// @param residuals resized to rows() x outputs [N m or N]. @param jacobian may be null; else
  /// resized to (rows() outputs) x variables, the rows of output 0 first.
  Status evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals,
                  Eigen::MatrixXd* jacobian) override;
  /// Velocities and accelerations of the joints of the outputs at the rows, not filtered like
  /// residuals; rows() x outputs. Without a residual_cutoff and signals only.
  void motion_of_outputs(Eigen::MatrixXd* velocity, Eigen::MatrixXd* acceleration) const;
  /// Once set, evaluations end soon with kCancelled; nullptr: never.
  void obey(const std::atomic<bool>* cancel) override { model_->obey(cancel); }

 private:
  MotionSamples samples_of_all(const std::vector<std::string>& joints);
  /// The samples at which joints rest between bounds.
  RestBounds bounds_of(const MotionSamples& samples,
                       const std::vector<MeasuredJoint>& joints) const;
  void refuse_bounds_of_projected() const;
  /// The shift of each joint whose start is fitted: its start in x minus the start from which its
  /// positions were integrated; shifted joints x recordings [rad or m].
  Eigen::MatrixXd shifts(const Eigen::VectorXd& x) const;
  /// Shifts these joints to their starts in x. If that is far from the motion that begin()
  /// followed, calls begin() again.
  Status place(const Eigen::VectorXd& x);
  double time(std::size_t recording, Eigen::Index sample) const;
  /// Sets the first column of `columns` to the residual of an output, the other columns to its
  /// derivatives; one row per sample of the motion. @param at the model's sample for each
  void fill(std::size_t recording, std::size_t output, const Eigen::VectorXd& x, bool with_slopes,
            const std::function<Eigen::Index(Eigen::Index)>& at, Eigen::MatrixXd* columns) const;
  /// The rows to fit of an output, filtered.
  Eigen::MatrixXd rows_of(std::size_t recording, std::size_t output, const Eigen::VectorXd& x,
                          bool with_slopes) const;
  /// Sets columns of starts to zero that hold only rounding errors, so that they do not seem
  /// independent of all others.
  void clear_starts_without_effect(Eigen::MatrixXd* jacobian) const;
  /// Filters the columns and keeps the rows to fit.
  Eigen::MatrixXd fitted(std::size_t recording, Eigen::MatrixXd* columns) const;
  /// The same of residuals: zero where samples do not count.
  Eigen::MatrixXd counted_of(std::size_t recording, std::size_t output,
                             Eigen::MatrixXd* columns) const;
  /// Whether an output is the effort of a joint whose rests lie between bounds.
  bool is_bounded(std::size_t recording, std::size_t output) const;
  /// Whether a sample of the motion counts.
  bool counts(std::size_t recording, std::size_t output, Eigen::Index sample) const;
  const Eigen::VectorXd& recorded_of(const MeasuredMotion& recording, std::size_t output) const;
  void record();
  void count();

  const FitVariables& variables_;
  const std::vector<MeasuredMotion> recordings_;
  const FilterOptions filter_;
  const std::vector<SignalDescription> signals_;
  std::vector<std::string> outputs_;
  std::vector<int> drives_;  ///< per output: its row in the model's efforts and signals
  std::vector<std::vector<RecordedEffort>> efforts_;  ///< [recording][output]
  /// the first sample of each recording in the motion; then the number of samples
  std::vector<Eigen::Index> begins_;
  std::unique_ptr<RestBounds> bounds_;
  std::unique_ptr<EffortModel> model_;
  /// [recording][shifted joint of the model]: index of its start in x; -1: known
  std::vector<std::vector<int>> start_columns_;
  Eigen::VectorXd begun_;  ///< the x given to begin()
  SeriesLengths lengths_;
  Eigen::Index rows_ = 0;
  Eigen::MatrixXd recorded_, counted_, model_efforts_;
  RowJacobian model_jacobian_;
};

}  // namespace codesign
