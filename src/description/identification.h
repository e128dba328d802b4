// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "description/loss_law.h"
#include "description/signal.h"
#include "mechanism_codesign/error.h"

namespace codesign {

// The block `identify:` of a study: which recordings a model is fitted to, and how; doc/study.md
// describes the keys.

/// The recorded quantities of a joint, in the units of the joint: [rad or m], [rad/s or m/s], [N m
/// or N].
enum class MeasuredQuantity { kPosition, kVelocity, kEffort };
constexpr std::array<const char*, 3> kMeasuredQuantityNames{"position", "velocity", "effort"};

/// A column of a table of numbers, by its name or its number. Its value is scale * (number as
/// written) + offset.
struct ColumnDescription {
  std::string name;     ///< empty: the column has the number `number`
  int number = 0;       ///< from 1; 0: the column has the name `name`
  double scale = 1.0;   ///< not 0
  double offset = 0.0;  ///< in the unit of the scaled value
  SourceLocation where;
  std::string element;  ///< its place in the study, for messages: `identify.data[0].columns.time`
};

/// A column that holds a quantity of a joint.
struct MeasuredColumn {
  std::string joint;
  MeasuredQuantity quantity = MeasuredQuantity::kPosition;
  ColumnDescription column;
};

/// The delimiter between the cells of a row.
enum class CellDelimiter {
  /// the first of tab, semicolon and comma that the first row contains; white space if none is
  /// there
  kAuto,
  kComma,
  kSemicolon,
  kTab,
  kSpace  ///< any white space
};
constexpr std::array<const char*, 5> kCellDelimiterNames{"auto", "comma", "semicolon", "tab",
                                                         "space"};

/// Which time of a message counts.
enum class StampKind {
  kHeader,  ///< the stamp that the publisher wrote
  kReceive  ///< when the bag's recorder received it
};
constexpr std::array<const char*, 2> kStampNames{"header", "receive"};

/// The treatment of gaps, pauses of more than a few periods.
enum class GapRule {
  kRefuse,  ///< it is an error
  kSplit    ///< the recording is used as several
};
constexpr std::array<const char*, 2> kGapRuleNames{"refuse", "split"};

/// A number that is known, or to be fitted together with the tuned parameters.
struct FittedNumber {
  explicit FittedNumber(double known = 0.0) : value(known) {}

  double value;  ///< known, or where the fit starts
  bool is_fitted = false;
  double lower = -std::numeric_limits<double>::infinity();  ///< bounds of a fitted number
  double upper = std::numeric_limits<double>::infinity();
  SourceLocation where;
};

/// Where a joint is at the first sample of a recording that holds its velocity but no positions
/// [rad or m].
struct StartPosition {
  std::string joint;
  FittedNumber position;
};

/// A parameter with a value of its own in one recording: `set: {payload: 2.8}`.
struct RecordedSetting {
  int parameter = 0;  ///< index in Study::parameters
  double value = 0.0;
};

/// What counts of the samples at which a joint is slower than its mask: `mask: {rest: bounds}`.
enum class RestRule {
  kLeaveOut,
  kBounds,  ///< the distance from the efforts between which friction at rest is, theory (28d)
};
constexpr std::array<const char*, 2> kRestRuleNames{"leave_out", "bounds"};

/// Below which speed of a joint its samples do not count: `mask: {speed: 0.01}`.
struct SpeedMask {
  std::string joint;   ///< empty: each joint
  double speed = 0.0;  ///< [rad/s or m/s], positive
  SourceLocation where;
};

/// A column that holds a signal of the model.
struct SignalColumn {
  SignalDescription signal;
  ColumnDescription column;
};

/// What priors of free inertias are about: `prior: {mass: 0.3}`.
constexpr std::array<const char*, 3> kFreeInertiaParts{"mass", "centre", "inertia"};

/// What is known of a tuned parameter before the fit: a normal distribution about its start;
/// doc/theory.md (39b).
struct PriorDescription {
  std::string parameter;   ///< its name, or one of kFreeInertiaParts for all free inertias
  double deviation = 0.0;  ///< standard deviation, relative to the start
  SourceLocation where;
};

/// One entry of `identify.data` or `identify.holdout`: a topic of a bag, or a table of numbers as
/// text.
struct RecordingDescription {
  std::string file;  ///< as written; relative to the folder of the study
  bool is_bag = false;
  std::string topic;                               ///< of a bag: sensor_msgs/JointState
  StampKind stamp = StampKind::kHeader;            ///< of a bag
  CellDelimiter delimiter = CellDelimiter::kAuto;  ///< of a table
  /// of a table; without columns they are found by their names
  std::optional<ColumnDescription> time;
  std::vector<MeasuredColumn> columns;  ///< of a table
  /// part to use [s]: of the time column, or from the bag's first message
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
  GapRule gaps = GapRule::kRefuse;
  std::vector<StartPosition> starts;      ///< of joints whose positions are integrated
  std::vector<RecordedSetting> settings;  ///< values of parameters in this recording
  std::vector<SpeedMask> masks;
  RestRule rest = RestRule::kLeaveOut;  ///< of the masks
  std::vector<SignalColumn> signals;    ///< of a table: signals that are compared, too
  std::string element;                  ///< `identify.data[0]`
  SourceLocation where;
};

/// The relation between the effort tau(t) on a joint and its recorded effort e: effort_scale e(t +
/// delay) = tau(t) + offset; doc/theory.md (28c).
struct JointCalibration {
  std::string joint;
  FittedNumber effort_scale{1.0};  ///< e.g. torque constant times gear ratio; not 0
  /// by which the recorded effort is late beside the recorded motion [s]; negative: early
  FittedNumber delay{0.0};
  FittedNumber offset{0.0};  ///< recorded beyond the effort that the mechanism needs [N m or N]
  SourceLocation where;
};

/// The quantities that are compared with the recording.
enum class ResidualKind {
  kEffort,  ///< inverse dynamics at the measured motion
  kMotion   ///< simulated motion, in segments
};
constexpr std::array<const char*, 2> kResidualNames{"effort", "motion"};

/// Zero-phase low-pass filters and the rate of fitted samples; doc/theory.md (29)-(31).
struct FilterOptions {
  double cutoff = 0.0;  ///< of measured motion before it is differentiated [Hz]; 0: no filter
  double residual_cutoff = 0.0;  ///< of measured and computed efforts alike [Hz]; 0: no filter
  int order = 4;                 ///< of the Butterworth filter, which runs forward and backward
  int decimate = 1;              ///< of the filtered samples, every decimate-th one is fitted
  SourceLocation where;
};

/// The loss of the residuals, each over the spread of the residuals of its joint: that of a sum of
/// squares, or one that lets outliers count less.
struct LossOptions {
  LossKind kind = LossKind::kSquare;  ///< with LossLaw::weight
  double scale = 1.345;               ///< 95 % efficient for normal residuals (Huber)
};

/// How the noise of residuals is taken in intervals; doc/theory.md (33)-(36).
enum class NoiseModel {
  kWhite,       ///< independent, equal variance
  kCorrelated,  ///< Newey and West
  kBootstrap    ///< moving blocks
};
constexpr std::array<const char*, 3> kNoiseNames{"white", "correlated", "bootstrap"};
struct IntervalOptions {
  double level = 0.95;  ///< in (0, 1)
  NoiseModel noise = NoiseModel::kCorrelated;
  /// of the kernel, or length of the blocks, in fitted samples; 0: chosen automatically
  int lag = 0;
  bool profiles = false;  ///< intervals of the profile likelihood, too
};

/// The whole block.
struct IdentificationDescription {
  std::vector<RecordingDescription> data;     ///< fitted; at least one
  std::vector<RecordingDescription> holdout;  ///< judged on, never fitted
  ResidualKind residual = ResidualKind::kEffort;
  double segment = 1.0;  ///< duration of the segments of kMotion [s]
  FilterOptions filter;
  std::vector<JointCalibration> joints;  ///< the joints that the study names
  LossOptions loss;
  IntervalOptions intervals;
  std::vector<PriorDescription> priors;
  SourceLocation where;
};

}  // namespace codesign
