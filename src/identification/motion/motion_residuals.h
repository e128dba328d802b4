// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "identification/fit/residual_source.h"
#include "identification/motion/segments.h"

namespace codesign {

/// Residuals of several recordings of one robot as functions of x, with the motion simulated in
/// segments: computed minus recorded positions, velocities, efforts of controllers, and signals,
/// doc/theory.md (40)-(43). The start of each segment is free. Without a Jacobian, evaluate() uses
/// the best start of each segment. With a Jacobian, starts and x are unknowns of one Gauss-Newton
/// step: the starts take their part of the step from the best point so far, and the Jacobian
/// includes that starts follow x. Segments are shared among threads; the results are the same to
/// the last bit for any number of threads.
class MotionResiduals final : public RecordingResiduals {
 public:
  /// @param system, variables, options must outlive this. @param recordings all with the same
  /// joints. @param joints the joints of the recordings, as require_same_joints() returns them.
  /// @throws InputError if the joints do not determine the motion, and for segments that are too
  /// short.
  MotionResiduals(const CompiledSystem& system, const FitVariables& variables,
                  const IdentificationDescription& options,
                  const std::vector<MeasuredJoint>& joints, std::vector<JointRecording> recordings,
                  int threads, Warnings* warnings);
  ~MotionResiduals() override;

  /// `elbow_joint/position`, and so on.
  const std::vector<std::string>& outputs() const override { return names_; }
  const SeriesLengths& lengths() const override { return lengths_; }
  /// The segments.
  const SeriesLengths& pieces() const override { return pieces_; }
  Eigen::Index rows() const override { return recorded_.rows(); }
  std::vector<double> times() const override;
  const Eigen::MatrixXd& recorded() const override { return recorded_; }
  /// A start alone, without any force, moves on a straight line: positions of each segment without
  /// their line, velocities without their mean; efforts and signals without the mean of all.
  Eigen::MatrixXd variation() const override;
  std::size_t signals() const override { return signals_; }
  Status begin(const Eigen::VectorXd& x) override;
  /// A segment that cannot be simulated fails the evaluation; the status names it.
  Status evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals,
                  Eigen::MatrixXd* jacobian) override;
  void count_by(const Eigen::VectorXd& spreads, const LossOptions& loss) override;
  Eigen::Index own_unknowns() const override;
  double inner_decrease() const override { return inner_decrease_; }
  void obey(const std::atomic<bool>* cancel) override { cancel_ = cancel; }

  /// Simulations of segments so far divided by the number of segments, the cost of the evaluations.
  double runs() const { return static_cast<double>(runs_) / static_cast<double>(places_.size()); }
  /// The part of runs() with derivatives by x and starts; the other simulations have derivatives by
  /// starts alone.
  double whole_runs() const {
    return static_cast<double>(whole_runs_) / static_cast<double>(places_.size());
  }
  const std::vector<SegmentSystem>& systems() const { return systems_; }
  const std::vector<std::vector<Segment>>& segments() const { return segments_; }

 private:
  struct MotionWorker;
  /// The place of a segment among recordings and rows.
  struct SegmentRow {
    std::size_t recording, segment;
    Eigen::Index row;  ///< row of its first sample
  };
  /// The starts at the best x so far, and how they follow x.
  struct BestPoint {
    Eigen::VectorXd x;
    double value = 0.0;
    std::vector<Eigen::VectorXd> starts, corrections;  ///< SegmentSolution::correction
    std::vector<Eigen::MatrixXd> slopes;
    std::vector<double> predicted_decreases;
  };
  /// The best starts at the last x without a Jacobian.
  struct BestStarts {
    Eigen::VectorXd x;
    std::vector<Eigen::VectorXd> starts;
  };
  /// per segment: starts to begin with; empty: the segment is skipped
  using Guesses = std::vector<std::vector<Eigen::VectorXd>>;
  Guesses guesses(const Eigen::VectorXd& x) const;
  Status solve(const Eigen::VectorXd& x, const Guesses& guesses, SegmentWork work,
               std::vector<SegmentSolution>* solutions);
  Status solve_all(const Eigen::VectorXd& x, std::vector<SegmentSolution>* solutions);
  Status help_slow_starts(const Eigen::VectorXd& x, std::vector<SegmentSolution>* solutions);
  Status improve(const Eigen::VectorXd& x, Guesses from, SegmentWork work,
                 std::vector<SegmentSolution>* solutions, Guesses* improved);
  void remember(const Eigen::VectorXd& x, double value,
                const std::vector<SegmentSolution>& solutions);
  Status failure_of(std::size_t place, Status status) const;

  const CompiledSystem& system_;
  const FitVariables& variables_;
  const std::vector<JointRecording> recordings_;
  LossOptions loss_;
  Eigen::VectorXd spreads_;
  std::vector<std::string> independent_, names_;
  std::size_t signals_ = 0;             ///< among the outputs
  std::vector<SegmentSystem> systems_;  ///< per recording
  /// [recording][output], of efforts
  std::vector<std::vector<std::optional<RecordedEffort>>> efforts_;
  std::vector<std::vector<Segment>> segments_;          ///< [recording]
  std::vector<SegmentRow> places_;                      ///< of all segments
  std::vector<std::unique_ptr<MotionWorker>> workers_;  ///< one per thread
  SeriesLengths lengths_, pieces_;
  Eigen::MatrixXd recorded_;
  BestPoint best_;
  /// whether best_.value was computed with other spreads or another loss
  bool is_recounted_ = true;
  BestStarts best_starts_;
  double inner_decrease_ = 0.0;  ///< inner_decrease()
  std::int64_t runs_ = 0, whole_runs_ = 0;
  const std::atomic<bool>* cancel_ = nullptr;
};

}  // namespace codesign
