// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/effort_doubts.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "description/study.h"
#include "identification/effort/effort_residuals.h"
#include "identification/effort/filter_doubt.h"
#include "identification/fit/given_motion.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr int kSamples = 400;  // per recording
// A model as it stands may be wrong by this factor without a doubt about units.
constexpr double kUsualScale = 4.0;

/// Efforts of all joints as recorded and as the model as it stands needs them, with the motion;
/// rows x joints.
struct EffortEvidence {
  std::vector<std::string> joints;
  Eigen::MatrixXd recorded, computed, velocity, acceleration;
  Eigen::MatrixXd by_x;                ///< derivatives of the residuals, the rows of joint 0 first
  std::vector<std::vector<int>> rows;  ///< those that count, of each joint

  Eigen::VectorXd of(std::size_t joint, const Eigen::VectorXd& column) const {
    return column(rows[joint]);
  }
};

std::vector<std::vector<int>> counted_rows(const Eigen::MatrixXd& recorded,
                                           const Eigen::MatrixXd& counted) {
  std::vector<std::vector<int>> rows(to_index(recorded.cols()));
  for (Eigen::Index joint = 0; joint < recorded.cols(); ++joint)
    for (Eigen::Index row = 0; row < recorded.rows(); ++row)
      if (counted.size() == 0 || counted(row, joint) != 0.0)
        rows[to_index(joint)].push_back(static_cast<int>(row));
  return rows;
}

/// Viscous and dry friction and a rotor, per unit; rows x 3.
Eigen::MatrixXd drive_line_columns(const Eigen::VectorXd& velocity,
                                   const Eigen::VectorXd& acceleration) {
  constexpr double kSlowShare = 0.1;
  const double slow = std::max(
      kSlowShare * std::sqrt(velocity.squaredNorm() / static_cast<double>(velocity.size())),
      1e-300);
  Eigen::MatrixXd columns(velocity.size(), 3);
  columns << velocity, (velocity.array() / slow).tanh().matrix(), acceleration;
  return columns;
}

/// Unfiltered efforts at few samples, or at all.
std::vector<MeasuredMotion> thinned_motions(const std::vector<JointRecording>& recordings,
                                            FilterOptions filter, bool is_thinned) {
  Warnings known_warnings;
  filter.residual_cutoff = 0.0;
  filter.decimate = 1;
  std::vector<MeasuredMotion> motions;
  for (const JointRecording& recording : recordings) {
    motions.push_back(measured_motion(recording, filter, &known_warnings));
    for (JointMotion& joint : motions.back().joints) joint.has_bounds = false;
    if (is_thinned)
      motions.back().every = std::max<Eigen::Index>(1, motions.back().fitted() / kSamples);
  }
  return motions;
}

std::optional<EffortEvidence> evidence_of(const Problem& problem, const FitVariables& variables,
                                          const std::vector<JointRecording>& recordings) {
  const std::vector<MeasuredJoint> joints = require_same_joints(recordings);
  FilterOptions filter = study_of(problem).identification->filter;
  filter.residual_cutoff = 0.0;
  const auto residuals_at = [&](bool is_thinned) {
    return std::make_unique<EffortResiduals>(*system_of(problem), variables, joints,
                                             thinned_motions(recordings, filter, is_thinned),
                                             filter, 1);
  };
  // A mask that leaves enough samples may leave too few of those that are used here.
  std::unique_ptr<EffortResiduals> source = residuals_at(true);
  if (!is_counted(source->counted())) source = residuals_at(false);
  EffortResiduals& residuals = *source;
  require_counted(residuals.outputs(), residuals.counted(), recordings);
  EffortEvidence evidence;
  const Eigen::VectorXd& x = variables.start();
  if (!residuals.begin(x).ok() || !residuals.evaluate(x, &evidence.computed, &evidence.by_x).ok())
    return std::nullopt;
  evidence.joints = residuals.outputs();
  evidence.recorded = residuals.recorded();
  evidence.computed += evidence.recorded;
  evidence.rows = counted_rows(evidence.recorded, residuals.counted());
  residuals.motion_of_outputs(&evidence.velocity, &evidence.acceleration);
  return evidence;
}

/// As evidence_of(). What inverse dynamics refuse, such as friction with states, is no error of a
/// study with residuals in motion.
std::optional<EffortEvidence> usable_evidence(const Problem& problem, const FitVariables& variables,
                                              const std::vector<JointRecording>& recordings) {
  if (study_of(problem).identification->residual != ResidualKind::kMotion)
    return evidence_of(problem, variables, recordings);
  try {
    return evidence_of(problem, variables, recordings);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

DriveLineFit fit_of(const EffortEvidence& evidence, std::size_t joint,
                    const Eigen::VectorXd& recorded) {
  const auto k = to_signed(joint);
  const auto counted = [&](const Eigen::VectorXd& column) { return evidence.of(joint, column); };
  return fit_drive_line(counted(evidence.computed.col(k)), counted(evidence.velocity.col(k)),
                        counted(evidence.acceleration.col(k)), counted(recorded));
}

double mean_share(const EffortEvidence& evidence) {
  double sum = 0.0;
  for (std::size_t k = 0; k < evidence.joints.size(); ++k)
    sum += fit_of(evidence, k, evidence.recorded.col(to_signed(k))).share;
  return sum / static_cast<double>(evidence.joints.size());
}

void take_if_better(double share, const std::string& mistake, EffortDoubt* doubt) {
  if (share < kExplainedHalf ||
      share < std::max(doubt->share, doubt->mended) + (doubt->mistake.empty() ? kClearly : 0.0))
    return;
  doubt->mended = share;
  doubt->mistake = mistake;
}

/// The share of the squares of `column` about its mean that `known` leaves.
double share_left(const Eigen::VectorXd& column, const PivotedLeastSquares& known) {
  const Eigen::VectorXd about_mean = about_mean_of(column);
  const double all = about_mean.squaredNorm();
  return all > 0.0 ? std::max(0.0, 1.0 - known.explained(about_mean) / all) : 0.0;
}

/// Whether one factor of all efforts of the model explains a recording as well as all changes of
/// the numbers that are to be found: then the recording has another unit. If those numbers alone
/// explain it, their starts are wrong. A start that is all of the effort tells nothing.
bool is_factor_of_all(const EffortEvidence& evidence, std::size_t joint) {
  constexpr double kAlike = 2.0, kNothingLeft = 0.01, kHasIt = 0.2, kIsAll = 1e-3;
  const auto k = to_signed(joint);
  const std::vector<int>& counted = evidence.rows[joint];
  const auto rows = to_signed(counted.size());
  const Eigen::MatrixXd whole =
      evidence.by_x.middleRows(k * evidence.recorded.rows(), evidence.recorded.rows());
  const Eigen::MatrixXd free = about_mean_of(whole(counted, Eigen::all));
  const Eigen::VectorXd computed = evidence.of(joint, evidence.computed.col(k)),
                        recorded = evidence.of(joint, evidence.recorded.col(k));
  for (Eigen::Index i = 0; i < free.cols(); ++i)
    if (share_left(computed, PivotedLeastSquares(free.col(i))) < kIsAll) return false;
  const PivotedLeastSquares by_numbers(free);
  // Friction and rotor count beside the model where it lacks them.
  Eigen::MatrixXd scaled(rows, 4);
  scaled << computed, drive_line_columns(evidence.of(joint, evidence.velocity.col(k)),
                                         evidence.of(joint, evidence.acceleration.col(k)));
  scaled = about_mean_of(std::move(scaled));
  for (Eigen::Index i = 1; i < scaled.cols(); ++i)
    if (share_left(scaled.col(i), by_numbers) < kHasIt) scaled.col(i).setZero();
  Eigen::MatrixXd left = scaled.rightCols(3);
  Eigen::MatrixXd changed(rows, free.cols() + 3);
  changed << free, left;
  const double reference = about_mean_of(recorded).squaredNorm();
  const Eigen::VectorXd error = about_mean_of(recorded - computed);
  const double by_factor = share_left(recorded, PivotedLeastSquares(scaled)),
               by_changes = reference > 0.0 ? share_left(error, PivotedLeastSquares(changed)) *
                                                  error.squaredNorm() / reference
                                            : 0.0;
  return by_factor <= kAlike * by_changes + kNothingLeft;
}

/// Another sign, unit or column of the efforts.
EffortDoubt doubt_column(const EffortEvidence& evidence, std::size_t joint, bool is_scale_known) {
  const auto own = to_signed(joint);
  const DriveLineFit as_recorded = fit_of(evidence, joint, evidence.recorded.col(own));
  EffortDoubt doubt{evidence.joints[joint], as_recorded.share, "", 0.0};
  const double scale = as_recorded.scale;
  if (as_recorded.share >= kExplainedHalf) {
    if (is_scale_known && scale > 0.0 && (scale > kUsualScale || scale < 1.0 / kUsualScale) &&
        is_factor_of_all(evidence, joint)) {
      doubt.mistake = "divided by about " + readable(scale, 4);
      doubt.mended = as_recorded.share;
      doubt.is_unit = true;
      // As recorded, without a free scale.
      const Eigen::VectorXd recorded = evidence.of(joint, evidence.recorded.col(own)),
                            computed = evidence.of(joint, evidence.computed.col(own));
      doubt.share = explained_share(recorded, computed - recorded);
    }
    return doubt;
  }
  for (Eigen::Index k = 0; k < evidence.recorded.cols(); ++k)
    for (const double sign : {1.0, -1.0}) {
      if (k == own && sign > 0.0) continue;
      const std::string other =
          k == own ? "" : "with the column of " + evidence.joints[to_index(k)];
      const std::string minus = sign > 0.0 ? ""
                                : k == own ? "with the other sign"
                                           : " and the other sign";
      take_if_better(fit_of(evidence, joint, sign * evidence.recorded.col(k)).share, other + minus,
                     &doubt);
    }
  return doubt;
}

using Order = std::vector<std::size_t>;

/// Recordings in which joint k bears the name of joint order[k].
std::vector<JointRecording> renamed(std::vector<JointRecording> recordings,
                                    const std::vector<std::string>& joints, const Order& order) {
  for (JointRecording& recording : recordings)
    for (JointSamples& samples : recording.joints) {
      const auto found = std::find(joints.begin(), joints.end(), samples.joint);
      if (found != joints.end()) samples.joint = joints[order[to_index(found - joints.begin())]];
    }
  return recordings;
}

/// The reversed order, and the exchanges of a doubted joint with another one; with their names.
std::vector<std::pair<Order, std::string>> orders_of(const std::vector<EffortDoubt>& doubts,
                                                     const std::vector<std::string>& joints) {
  Order usual;
  for (std::size_t k = 0; k < joints.size(); ++k) usual.push_back(k);
  std::vector<std::pair<Order, std::string>> orders{
      {Order(usual.rbegin(), usual.rend()), "with the joints in reversed order"}};
  for (std::size_t i = 0; i < joints.size(); ++i)
    for (std::size_t j = i + 1; j < joints.size(); ++j) {
      const auto names = [&](const EffortDoubt& doubt) {
        return doubt.joint == joints[i] || doubt.joint == joints[j];
      };
      if (joints.size() == 2 || std::none_of(doubts.begin(), doubts.end(), names)) continue;
      orders.emplace_back(usual,
                          "with all columns of " + joints[i] + " and " + joints[j] + " exchanged");
      std::swap(orders.back().first[i], orders.back().first[j]);
    }
  return orders;
}

/// Whole joints under other names, which is judged by the efforts of all joints together. It counts
/// if it explains more than all columns that were found.
void doubt_order(const Problem& problem, const FitVariables& variables,
                 const std::vector<JointRecording>& recordings, const EffortEvidence& as_recorded,
                 std::vector<EffortDoubt>* doubts) {
  const auto count = static_cast<double>(as_recorded.joints.size());
  const double usual = mean_share(as_recorded);
  double with_columns = usual;
  for (const EffortDoubt& doubt : *doubts)
    if (!doubt.mistake.empty() && !doubt.is_unit)
      with_columns += (doubt.mended - doubt.share) / count;
  EffortDoubt best{"", usual, "", 0.0};
  for (const auto& [order, name] : orders_of(*doubts, as_recorded.joints)) {
    const std::optional<EffortEvidence> evidence =
        evidence_of(problem, variables, renamed(recordings, as_recorded.joints, order));
    if (evidence && std::is_permutation(evidence->joints.begin(), evidence->joints.end(),
                                        as_recorded.joints.begin(), as_recorded.joints.end()))
      take_if_better(mean_share(*evidence), name, &best);
  }
  for (EffortDoubt& doubt : *doubts) {
    if (doubt.is_unit || doubt.cutoff > 0.0 || !(best.mended > with_columns)) continue;
    doubt.mistake = best.mistake;
    doubt.mended = best.mended;
  }
}

}  // namespace

double explained_share(const Eigen::VectorXd& recorded, const Eigen::VectorXd& variation,
                       const Eigen::VectorXd& residuals, double least) {
  const double reference =
      std::max(variation.squaredNorm(), least * least * recorded.squaredNorm());
  return reference > 0.0 ? 1.0 - residuals.squaredNorm() / reference : 1.0;
}

double explained_share(const Eigen::VectorXd& recorded, const Eigen::VectorXd& residuals) {
  return explained_share(recorded, about_mean_of(recorded), residuals, kLeastVariation);
}

// Least squares of the recorded column by a constant of any sign and four columns with factors that
// cannot be negative: their signs are known whatever the values are. The best of all subsets of the
// four with positive factors is the solution.
DriveLineFit fit_drive_line(const Eigen::VectorXd& computed, const Eigen::VectorXd& velocity,
                            const Eigen::VectorXd& acceleration, const Eigen::VectorXd& recorded) {
  constexpr int kColumns = 4;
  constexpr double kLeastPart = 0.1;
  Eigen::MatrixXd columns(computed.size(), kColumns);
  columns << computed, drive_line_columns(velocity, acceleration);
  columns = about_mean_of(std::move(columns));
  const Eigen::VectorXd lengths = columns.colwise().norm().cwiseMax(1e-300);
  columns = columns * lengths.cwiseInverse().asDiagonal();
  const Eigen::VectorXd about_mean = about_mean_of(recorded);
  const Eigen::MatrixXd squares = transposed_product(columns, columns);
  const Eigen::VectorXd products = columns.transpose() * about_mean;
  DriveLineFit best;
  double most = 0.0;
  for (int subset = 1; subset < 1 << kColumns; ++subset) {
    std::vector<int> chosen;
    for (int k = 0; k < kColumns; ++k)
      if ((subset >> k) % 2 == 1) chosen.push_back(k);
    const Eigen::VectorXd factors = least_norm(squares(chosen, chosen)).solve(products(chosen));
    const double explained = factors.dot(Eigen::VectorXd(products(chosen)));
    if (!(factors.minCoeff() > 0.0) || !(explained > most)) continue;
    most = explained;
    // Beside friction and rotor that explain nearly all, the scale of the computed effort is not
    // known.
    const bool has_part = chosen.front() == 0 && factors[0] * products[0] >= kLeastPart * explained;
    best.scale = has_part ? factors[0] / lengths[0] : 0.0;
  }
  const double left = std::max(0.0, about_mean.squaredNorm() - most);
  best.share = explained_share(recorded, about_mean, Eigen::VectorXd::Constant(1, std::sqrt(left)),
                               kLeastVariation);
  return best;
}

std::vector<EffortDoubt> find_effort_doubts(const Problem& problem,
                                            const std::vector<JointRecording>& recordings,
                                            double explained) {
  if (recordings.empty()) return {};
  if (!study_of(problem).motion.empty())
    if (const auto completed = with_given_motions(problem, {recordings, {}}))
      return find_effort_doubts(problem, completed->data, explained);
  const std::vector<MeasuredJoint> joints = require_same_joints(recordings);
  if (std::none_of(joints.begin(), joints.end(),
                   [](const MeasuredJoint& joint) { return joint.with_effort; }))
    return {};
  const FitVariables variables(study_of(problem), &robot_of(problem));
  const std::optional<EffortEvidence> evidence = usable_evidence(problem, variables, recordings);
  std::vector<EffortDoubt> doubts;
  for (std::size_t k = 0; evidence && k < evidence->joints.size(); ++k) {
    if (const auto filtered = doubt_filter(recordings, study_of(problem).identification->filter,
                                           evidence->joints[k])) {
      doubts.push_back(*filtered);
      continue;
    }
    const bool is_scale_known = variables.columns(evidence->joints[k]).scale < 0;
    EffortDoubt doubt = doubt_column(*evidence, k, is_scale_known);
    if (doubt.share < kExplainedHalf || !doubt.mistake.empty()) doubts.push_back(std::move(doubt));
  }
  if (explained + kClearly <= 1.0 &&
      std::any_of(doubts.begin(), doubts.end(),
                  [](const EffortDoubt& doubt) { return !doubt.is_unit && doubt.cutoff == 0.0; }))
    doubt_order(problem, variables, recordings, *evidence, &doubts);
  return doubts;
}

Warnings warnings_of(const IdentificationDescription& options,
                     const std::vector<EffortDoubt>& doubts) {
  Warnings warnings;
  for (const EffortDoubt& doubt : doubts)
    if (!doubt.mistake.empty())
      warnings.push_back(warn(
          "recording_effort",
          {options.where, "identify.data",
           "the recorded effort of " + doubt.joint +
               " contradicts inverse dynamics of the model as it stands: " + sentence_of(doubt),
           "",
           "efforts on the child along the axis of its joint, in N m or N; `scale` of a column "
           "converts"}));
  return warnings;
}

std::string sentence_of(const EffortDoubt& doubt) {
  if (doubt.cutoff > 0.0)
    return "the filter of the study, of " + readable(doubt.cutoff) + " Hz, leaves " +
           readable(100.0 * doubt.motion_left, 2) + " % of its recorded motion";
  if (doubt.mistake.empty()) return "";
  return doubt.mistake + ", the model as it stands would explain " +
         readable(100.0 * doubt.mended, 3) + " % of it";
}

}  // namespace codesign
