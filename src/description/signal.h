// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "description/expression.h"
#include "description/reference.h"
#include "mechanism_codesign/error.h"

namespace codesign {

/// One term of a signal: `+ crank_joint/velocity`, `- plate/position/x`.
struct SignalTerm {
  double factor = 1.0;   ///< +1 or -1
  std::string object;    ///< name of a joint, loop, link or controller
  std::string quantity;  ///< position, velocity, effort, friction, ...; the list is in doc/study.md
  /// x, y, z (of a link's orientation also w), or empty for scalar quantities
  std::string component;
  /// of a vector: the link in whose axes it is told, or kGroundAxes; empty: those of the quantity,
  /// SignalFacts::axes
  std::string axes{};
};

/// The root link as the name of axes, unless a link has this name.
inline constexpr const char* kGroundAxes = "ground";

/// An expression of signals, parameters and the time t: `${crank/effort * crank/velocity}`.
struct SignalFormula {
  ExpressionSteps steps;
  /// of the variables of the steps: signals, of which the k-th is SignalDescription::terms[k], and
  /// names without a slash
  std::vector<std::string> names;
  std::string text;  ///< what stands inside ${...}
};

/// A sum or difference of named signals, or an expression of signals; see doc/study.md.
struct SignalDescription {
  std::string text;
  std::vector<SignalTerm> terms;  ///< summed up, or the signals that the formula reads
  SourceLocation where;
  std::shared_ptr<const SignalFormula> formula{};  ///< null: the sum of the terms

  /// The term that the signal consists of, if it is one with the factor 1 and no expression; else
  /// null.
  const SignalTerm* only_term() const {
    return !formula && terms.size() == 1 && terms[0].factor == 1.0 ? &terms[0] : nullptr;
  }
};

/// Splits `a/position/x - b/position/x` into terms, or parses `${...}`. Names are not checked here;
/// see check_signal().
/// @throws InputError if the text does not have the form of a signal.
SignalDescription parse_signal(const std::string& text, const SourceLocation& where,
                               const std::string& element);

/// Parses `${...}`, a comparison of signals, parameters and the time or several ones joined by and,
/// or and not: a formula that is 1 where it holds and else 0.
/// @throws InputError if the text is no condition, or one of parameters alone.
SignalDescription parse_condition(const std::string& text, const SourceLocation& where,
                                  const std::string& element);

/// The signal `end_time`, the time at which a run ends [s]: the time as a formula, whose value
/// counts at the end.
inline constexpr const char* kEndTime = "end_time";
SignalDescription end_time_signal(const SourceLocation& where);

struct LinearMeasure;

/// A signal whose extreme values within an interval of time count: in a constraint (`path:`,
/// `final:`) or in the objective (`objective.peak`); theory (21a).
struct WatchedSignal {
  enum class Role {
    kPath,     ///< lower <= signal - reference <= upper at all times from `after` to `before`
    kFinal,    ///< the same at the end of the study; equal bounds are an equality
    kPeak,     ///< the objective contains weight * max |signal - reference| over the interval
    kBounded,  ///< lower <= measure of signal - reference over the interval <= upper
    kTerm      ///< the objective contains weight * measure
  };
  /// One number of the signal over the interval, theory (21e); of kBounded and kTerm.
  enum class Measure {
    kNone,
    kStroke,   ///< largest minus smallest value
    kMaximum,  ///< largest value
    kMinimum,  ///< smallest value
    kArrival,  ///< first time after which the signal stays within the band until `before` [s]
    kDwell     ///< time within the band [s], the sum of all stays
  };

  Role role = Role::kPath;
  Measure measure = Measure::kNone;
  SignalDescription signal;
  /// Null, or numbers of the linearization about rest take the place of the signal's values, theory
  /// (70): kMaximum or kMinimum of them, of kBounded and kTerm. `signal` then has a text only. In
  /// MotionStudy::watched they stand behind all signals.
  std::shared_ptr<const LinearMeasure> linear{};
  ReferenceDescription reference;  ///< 0 unless given
  /// of kPath, kFinal and kBounded, at least one of them; in the unit of the signal, of arrival and
  /// dwell in s
  std::optional<Quantity> lower, upper;
  Quantity band_lower, band_upper;  ///< of kArrival and kDwell, in the unit of the signal
  /// violation of a bound that counts as met, positive; empty: from the range of the signal
  std::optional<double> tolerance;
  double weight = 1.0;               ///< of kPeak, positive; of kTerm, not zero
  double after = 0.0, before = 0.0;  ///< the interval [s]; for kFinal both are the duration
  std::string element;               ///< its place in the study, for messages: `path[0]`
  SourceLocation where;
};

/// The measures as files name them, in the order of WatchedSignal::Measure without kNone.
constexpr std::array<const char*, 5> kMeasureNames{"stroke", "maximum", "minimum", "arrival",
                                                   "dwell"};
/// Whether the signal's number follows from the times at which it enters and leaves a band.
bool has_band(const WatchedSignal& watched);
/// Whether the signal is a term of the objective.
bool is_term(const WatchedSignal& watched);
/// Whether the signal is a term of the objective that is the largest of many values, whose corners
/// a slack variable takes away: peaks, strokes and maxima to minimize, minima to maximize.
bool is_largest_of_many(const WatchedSignal& watched);
/// The signal as written, with its measure: "stroke of slide/position".
std::string describe(const WatchedSignal& watched);

/// Whether a watched signal must have one value: `final:` with equal bounds, both constant.
bool is_equality(const WatchedSignal& watched);

/// Checks the order of the bounds at the start of a search: lower < upper, or lower <= upper for
/// kFinal. @param parameters all named ones.
/// @throws InputError
void require_ordered_bounds(const WatchedSignal& watched, const std::vector<double>& parameters);

}  // namespace codesign
