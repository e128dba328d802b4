// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/judgement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "identification/effort/effort_doubts.h"
#include "identification/fit/inertial_numbers.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "statistics/parameter_covariance.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// Of the range, or of the magnitude: a number nearer to its bound than this is on the bound.
constexpr double kNearBound = 1e-9;

double rms_of(const Eigen::VectorXd& column) {
  return std::sqrt(column.squaredNorm() / static_cast<double>(column.size()));
}

bool is_at(double x, double bound, double range) {
  return std::isfinite(bound) &&
         std::abs(x - bound) <= kNearBound * (std::isfinite(range) ? range : std::abs(bound));
}

/// The columns of the numbers that the data do not hold on a bound.
std::vector<int> free_columns(const IdentificationResult& result) {
  std::vector<int> columns;
  for (std::size_t k = 0; k < result.numbers.size(); ++k)
    if (!result.numbers[k].is_on_bound || !result.numbers[k].is_determined)
      columns.push_back(static_cast<int>(k));
  return columns;
}

/// Weighted residuals with the columns of the free numbers.
WeightedResiduals weighted_columns(const ResidualFit& fit, const LossOptions& loss,
                                   const std::vector<DelaySignal>& delays,
                                   const std::vector<int>& columns) {
  Eigen::MatrixXd by_x = fit.jacobian;
  for (const DelaySignal& delay : delays)
    if (delay.slopes.size() > 0)
      by_x.col(delay.column).segment(delay.output * fit.residuals.rows(), delay.slopes.size()) =
          delay.slopes;
  WeightedResiduals weighted = weigh(fit.residuals, &by_x, fit.spreads, loss);
  weighted.jacobian = Eigen::MatrixXd(weighted.jacobian(Eigen::all, columns));
  return weighted;
}

EliminatedUnknowns eliminated_from(const ResidualSource& source) {
  if (source.own_unknowns() == 0) return {0, {}, source.counted()};
  return {source.own_unknowns(), source.pieces(), source.counted()};
}

/// The covariance of the free numbers, by the noise model of `intervals`.
ParameterCovariance covariance_of(const ResidualFit& fit, const LossOptions& loss,
                                  const ResidualSource& source, const IntervalOptions& intervals,
                                  const std::vector<DelaySignal>& delays,
                                  const std::vector<int>& columns) {
  const WeightedResiduals weighted = weighted_columns(fit, loss, delays, columns);
  return parameter_covariance(weighted.residuals, weighted.jacobian, source.lengths(), intervals,
                              eliminated_from(source));
}

/// What the data determine of numbers that they do not determine each, and the sentences about
/// those. Free inertias appear by the numbers in which efforts are linear: combinations of these
/// are the same for all values.
void judge_combinations(const WeightedResiduals& weighted, const ResidualFit& fit,
                        const ResidualSource& source, const IntervalOptions& intervals,
                        const std::vector<int>& columns, const std::vector<std::string>& names,
                        const ParameterCovariance& plain, IdentificationResult* result) {
  if (plain.identifiability.dependent.empty()) return;  // each is determined
  const LinearNumbers numbers = with_inertial_numbers(names, fit.x(columns), weighted.jacobian);
  const ParameterCovariance changed =
      numbers.is_changed
          ? parameter_covariance(weighted.residuals, numbers.jacobian, source.lengths(), intervals,
                                 eliminated_from(source))
          : plain;
  const Identifiability& found = changed.identifiability;
  result->undetermined = describe_undetermined(found, numbers.names);
  for (Eigen::Index i = 0; i < numbers.x.size(); ++i) {
    const auto k = to_index(i);
    const bool is_dependent = std::find(found.dependent.begin(), found.dependent.end(),
                                        static_cast<int>(i)) != found.dependent.end();
    const bool is_told_alone = found.is_determined[k] && numbers.names[k] == names[k];
    if (is_dependent || is_told_alone) continue;
    const double value = combination_value(found, numbers.x, i);
    result->combinations.push_back(
        {combination_of(found, numbers.names, i), value, changed.combination_deviation[i],
         value - changed.combination_below[i], value + changed.combination_above[i]});
  }
}

IntervalOptions white(const IdentificationDescription& options) {
  IntervalOptions white = options.intervals;
  white.noise = NoiseModel::kWhite;
  return white;
}

/// How much larger variances are than with white noise, on average over what the data determine.
double inflation_of(const ParameterCovariance& known, const ParameterCovariance& plain) {
  double sum = 0.0;
  int determined = 0;
  for (Eigen::Index i = 0; i < known.covariance.rows(); ++i) {
    if (!known.identifiability.is_determined[to_index(i)] || !(plain.covariance(i, i) > 0.0))
      continue;
    sum += known.covariance(i, i) / plain.covariance(i, i);
    ++determined;
  }
  return determined > 0 ? sum / determined : 1.0;
}

void begin_numbers(const FitVariables& variables, const ResidualFit& fit,
                   IdentificationResult* result) {
  for (Eigen::Index k = 0; k < variables.size(); ++k) {
    IdentifiedNumber number;
    number.name = variables.names()[to_index(k)];
    number.unit = variables.units()[to_index(k)];
    number.start = variables.start()[k];
    number.value = number.low = number.high = fit.x[k];
    number.lower = variables.lower()[k];
    number.upper = variables.upper()[k];
    const double range = number.upper - number.lower;
    number.is_on_bound =
        is_at(number.value, number.lower, range) || is_at(number.value, number.upper, range);
    result->numbers.push_back(std::move(number));
  }
}

/// If other numbers can compensate a number on a bound, the data do not hold it there: it is not
/// determined.
void release_undetermined(const ResidualFit& fit, const LossOptions& loss,
                          IdentificationResult* result) {
  if (free_columns(*result).size() == result->numbers.size()) return;
  const Identifiability all =
      find_identifiable(weigh(fit.residuals, &fit.jacobian, fit.spreads, loss).jacobian);
  for (std::size_t k = 0; k < result->numbers.size(); ++k)
    result->numbers[k].is_determined = all.is_determined[k];
}

}  // namespace

namespace {

/// The samples of one output that count, and how many of each recording.
struct CountedSamples {
  std::vector<int> rows;
  SeriesLengths lengths;

  Eigen::VectorXd of(const Eigen::MatrixXd& columns, Eigen::Index output) const {
    return columns.col(output)(rows);
  }
};

CountedSamples counted_samples(const RecordingResiduals& source, const Eigen::MatrixXd& counted,
                               Eigen::Index output) {
  CountedSamples samples;
  Eigen::Index row = 0;
  for (const Eigen::Index length : source.lengths()) {
    const std::size_t before = samples.rows.size();
    for (const Eigen::Index end = row + length; row < end; ++row)
      if (counted.size() == 0 || counted(row, output) != 0.0)
        samples.rows.push_back(static_cast<int>(row));
    if (samples.rows.size() > before)
      samples.lengths.push_back(to_signed(samples.rows.size() - before));
  }
  return samples;
}

}  // namespace

std::vector<OutputFit> judge_outputs(const RecordingResiduals& source, const Eigen::MatrixXd& start,
                                     const Eigen::MatrixXd& residuals,
                                     const Eigen::VectorXd& spreads, const LossOptions& loss) {
  std::vector<OutputFit> fits;
  const Eigen::MatrixXd& recorded = source.recorded();
  const Eigen::MatrixXd variation = source.variation();
  const double least = source.own_unknowns() > 0 ? kLeastOfSegments : kLeastVariation;
  const Eigen::MatrixXd counted = source.counted();
  for (Eigen::Index k = 0; k < residuals.cols(); ++k) {
    const CountedSamples samples = counted_samples(source, counted, k);
    const Eigen::VectorXd left = samples.of(residuals, k), measured = samples.of(recorded, k);
    OutputFit fit;
    fit.joint = source.outputs()[to_index(k)];
    fit.is_signal = k + to_signed(source.signals()) >= residuals.cols();
    fit.counted = static_cast<double>(left.size()) / static_cast<double>(residuals.rows());
    fit.recorded = rms_of(measured);
    fit.start = rms_of(samples.of(start, k));
    fit.rms = rms_of(left);
    fit.worst = left.cwiseAbs().maxCoeff();
    const Eigen::ArrayXd roots = left.array().unaryExpr(
        [&](double r) { return std::sqrt(loss_of(loss, r / spreads[k]).weight); });
    fit.explained =
        explained_share(roots * measured.array(), roots * samples.of(variation, k).array(),
                        roots * left.array(), least);
    fit.whiteness = ljung_box(left, samples.lengths);
    fits.push_back(std::move(fit));
  }
  return fits;
}

void judge_numbers(const FitVariables& variables, const IdentificationDescription& options,
                   const ResidualSource& source, const std::vector<DelaySignal>& delays,
                   const ResidualFit& fit, IdentificationResult* result) {
  begin_numbers(variables, fit, result);
  for (const DelaySignal& delay : delays)
    result->numbers[to_index(delay.column)].slope_signal = delay.share;
  release_undetermined(fit, options.loss, result);
  const std::vector<int> columns = free_columns(*result);
  result->covariance.setZero(variables.size(), variables.size());
  if (columns.empty()) return;
  const WeightedResiduals weighted = weighted_columns(fit, options.loss, delays, columns);
  const ParameterCovariance known =
      parameter_covariance(weighted.residuals, weighted.jacobian, source.lengths(),
                           options.intervals, eliminated_from(source));
  std::vector<std::string> names;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto i = to_signed(k);
    IdentifiedNumber& number = result->numbers[to_index(columns[k])];
    number.is_determined = known.identifiability.is_determined[k];
    number.deviation = std::sqrt(known.covariance(i, i));
    number.low = number.value - known.below[i];
    number.high = number.value + known.above[i];
    names.push_back(number.name);
    for (std::size_t j = 0; j < columns.size(); ++j)
      result->covariance(columns[k], columns[j]) = known.covariance(i, to_signed(j));
  }
  result->rank = known.identifiability.rank;
  if (options.intervals.noise != NoiseModel::kWhite)
    result->inflation = inflation_of(
        known, parameter_covariance(weighted.residuals, weighted.jacobian, source.lengths(),
                                    white(options), eliminated_from(source)));
  result->lag = known.lag;
  judge_combinations(weighted, fit, source, options.intervals, columns, names, known, result);
}

bool decides_the_rest(const FitPrior& prior, const ResidualFit& fit, const LossOptions& loss,
                      const IdentificationResult& result) {
  if (prior.empty()) return false;
  const std::vector<int> columns = free_columns(result);
  const Identifiability found =
      find_identifiable(weighted_columns(fit, loss, {}, columns).jacobian);
  if (found.dependent.empty()) return true;
  return decides(prior, fit.x, columns, found);
}

bool decides(const FitPrior& prior, const Eigen::VectorXd& x, const std::vector<int>& columns,
             const Identifiability& found) {
  if (prior.empty()) return found.dependent.empty();
  const Eigen::MatrixXd slopes = prior.jacobian(x)(Eigen::all, columns);
  return find_identifiable(upper_factor(product(slopes, found.null_directions))).rank ==
         static_cast<int>(found.dependent.size());
}

Status not_identifiable(const std::string& what, const std::vector<std::string>& sentences) {
  constexpr std::size_t kTold = 3, kLongest = 120;
  Status status{StatusCode::kNotIdentifiable, 0.0, what};
  std::size_t told = 0;
  for (const std::string& sentence : sentences) {
    if (told == kTold) break;
    if (sentence.size() > kLongest) continue;
    status.cause += (told == 0 ? ": " : "; ") + sentence;
    ++told;
  }
  if (told < sentences.size())
    status.cause += (told == 0 ? ": " : "; and ") + std::to_string(sentences.size() - told) +
                    (told == 0 ? " combinations (\"undetermined\")" : " more (\"undetermined\")");
  return status;
}

void add_profiles(const FitProblem& problem, const IdentificationDescription& options,
                  const ResidualFit& fit, ResidualSource* source, const FitObserver& observer,
                  const std::atomic<bool>* cancel, IdentificationResult* result) {
  const std::vector<int> columns = free_columns(*result);
  const ParameterCovariance plain =
      covariance_of(fit, options.loss, *source, white(options), {}, columns);
  const Eigen::VectorXd degrees =
      covariance_of(fit, options.loss, *source, options.intervals, {}, columns).degrees;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    IdentifiedNumber& number = result->numbers[to_index(columns[k])];
    if (!number.is_determined || is_set(cancel)) continue;
    const auto i = to_signed(k);
    const double inflation = number.deviation * number.deviation / plain.covariance(i, i);
    ProfileProblem profile;
    profile.optimum = number.value;
    profile.cost = fit.cost;
    profile.threshold =
        profile_threshold(options.intervals.level, plain.residual_variance, inflation, degrees[i]);
    profile.step = 0.5 * (number.high - number.low);
    profile.lower = number.lower;
    profile.upper = number.upper;
    if (!(profile.step > 0.0) || !(profile.threshold > 0.0)) continue;
    number.profile = profile_interval(profile, [&](double value) -> std::optional<double> {
      FitProblem fixed = problem;
      fixed.start = fit.x;
      fixed.start[columns[k]] = fixed.lower[columns[k]] = fixed.upper[columns[k]] = value;
      const ResidualFit refit = fit_with_spreads(fixed, fit.spreads, source, [&](FitTrial trial) {
        trial.evaluation += result->evaluations;
        trial.iteration = fit.iterations;
        trial.profile = static_cast<int>(k) + 1;
        trial.profiles = static_cast<int>(columns.size());
        return !observer || observer(trial);
      });
      result->evaluations += refit.evaluations;
      if (!refit.status.ok()) return std::nullopt;
      return refit.cost;
    });
  }
}

}  // namespace codesign
