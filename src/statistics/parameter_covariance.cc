// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/parameter_covariance.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "math/arrays.h"
#include "math/dense.h"
#include "statistics/time_series.h"

namespace codesign {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr int kDraws = 2000;
constexpr std::uint32_t kSeed = 1;
// At least this many sums, fewer than twice as many, stand for the times of recordings.
constexpr Eigen::Index kSums = 500;
// More pieces than parameters, without which the sums over pieces do not tell a variance.
constexpr Eigen::Index kLeastDegrees = 3;

// Fewer pieces do not tell how their contributions are correlated from one to the next.
constexpr Eigen::Index kPiecesOfKernel = 20;
// Of one: what a piece leaves at least of a direction of the parameters to the other pieces. One
// that alone determines a direction has no residual along it.
constexpr double kLeastLeft = 0.01;

/// L with L L^T = (J^T J)^-1, p x rank, with rows of zeros for the parameters that depend on
/// others: these are held fixed while the others are determined.
Eigen::MatrixXd root_of_inverse(const Eigen::MatrixXd& R, const Identifiability& identifiability) {
  const Eigen::Index p = R.cols();
  const auto& dependent = identifiability.dependent;
  std::vector<int> independent;
  for (int k = 0; k < static_cast<int>(p); ++k)
    if (std::find(dependent.begin(), dependent.end(), k) == dependent.end())
      independent.push_back(k);
  const auto rank = to_signed(independent.size());
  Eigen::MatrixXd scaled(R.rows(), rank);
  Eigen::VectorXd lengths(rank);
  for (Eigen::Index k = 0; k < rank; ++k) {
    lengths[k] = R.col(independent[to_index(k)]).norm();
    scaled.col(k) = R.col(independent[to_index(k)]) / lengths[k];
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(p, rank);
  if (rank == 0) return result;
  const SingularValues svd = singular_values(scaled, SingularVectors::kRight);
  const Eigen::MatrixXd root =
      lengths.cwiseInverse().asDiagonal() * svd.V * svd.values.cwiseInverse().asDiagonal();
  for (Eigen::Index i = 0; i < rank; ++i) result.row(independent[to_index(i)]) = root.row(i);
  return result;
}

/// The contribution of each piece to the error of the parameters, pieces x p, as the other pieces
/// tell it, theory (43a): a piece with much of the information draws the fit, so that its residuals
/// are too small.
Eigen::MatrixXd contributions_of_pieces(const Eigen::MatrixXd& residuals,
                                        const Eigen::MatrixXd& jacobian,
                                        const Eigen::MatrixXd& root, const SeriesLengths& pieces) {
  Eigen::MatrixXd result(to_signed(pieces.size()), root.rows());
  Eigen::Index begin = 0;
  for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
    Eigen::MatrixXd left = Eigen::MatrixXd::Identity(root.cols(), root.cols());
    Eigen::VectorXd scores = Eigen::VectorXd::Zero(root.cols());
    for (Eigen::Index output = 0; output < residuals.cols(); ++output) {
      const Eigen::MatrixXd rows =
          jacobian.middleRows(output * residuals.rows() + begin, pieces[piece]) * root;
      left -= transposed_product(rows, rows);
      scores += rows.transpose() * residuals.col(output).segment(begin, pieces[piece]);
    }
    const SymmetricEigen eigen = symmetric_eigen(left);
    const Eigen::VectorXd told =
        (eigen.vectors.transpose() * scores).cwiseQuotient(eigen.values.cwiseMax(kLeastLeft));
    result.row(to_signed(piece)) = (root * (eigen.vectors * told)).transpose();
    begin += pieces[piece];
  }
  return result;
}

/// The contribution of each time to the error of the parameters, N x p: (J^T J)^-1 sum over outputs
/// of J^T r.
Eigen::MatrixXd contributions(const Eigen::MatrixXd& residuals, const Eigen::MatrixXd& jacobian,
                              const Eigen::MatrixXd& inverse) {
  Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(residuals.rows(), jacobian.cols());
  for (Eigen::Index output = 0; output < residuals.cols(); ++output)
    scores += residuals.col(output).asDiagonal() *
              jacobian.middleRows(output * residuals.rows(), residuals.rows());
  return scores * inverse;
}

/// A lag in sums over times, in times.
int in_times(int lag, Eigen::Index times, Eigen::Index sums) {
  return static_cast<int>(
      std::lround(lag * static_cast<double>(times) / static_cast<double>(sums)));
}

void set_symmetric_intervals(double level, ParameterCovariance* result) {
  result->below = interval_factor(level, result->degrees) *
                  result->covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  result->above = result->below;
}

void use_kernel(const Eigen::MatrixXd& terms, const SeriesLengths& lengths, double correction,
                const IntervalOptions& options, ParameterCovariance* result) {
  const LongRunCovariance estimate = long_run_covariance(terms, lengths, options.lag);
  result->covariance = correction * estimate.covariance;
  result->lag = estimate.lag;
  result->degrees = std::min(result->degrees, estimate.degrees);
  set_symmetric_intervals(options.level, result);
}

void use_independent(const Eigen::MatrixXd& terms, double correction,
                     const IntervalOptions& options, ParameterCovariance* result) {
  result->covariance = correction * (terms.transpose() * terms);
  result->lag = 1;
  set_symmetric_intervals(options.level, result);
}

// The errors of the parameters are distributed like the drawn sums, so that the interval mirrors
// their quantiles.
void use_bootstrap(const Eigen::MatrixXd& terms, const SeriesLengths& lengths, double correction,
                   const IntervalOptions& options, ParameterCovariance* result) {
  result->lag = options.lag > 0 ? options.lag : automatic_lag(terms, lengths);
  const Eigen::MatrixXd draws =
      std::sqrt(correction) * bootstrap_sums(terms, lengths, result->lag, kDraws, kSeed);
  result->covariance = draws.transpose() * draws / (kDraws - 1.0);
  result->below.resize(draws.cols());
  result->above.resize(draws.cols());
  for (Eigen::Index k = 0; k < draws.cols(); ++k) {
    result->below[k] = empirical_quantile(draws.col(k), 0.5 * (1.0 + options.level));
    result->above[k] = -empirical_quantile(draws.col(k), 0.5 * (1.0 - options.level));
  }
}

/// The contributions of single times do not matter, only their sums over equal parts of so many
/// times that the rate of the samples does not matter. A lag that is given counts times.
/// @param correction of the covariance for degrees of freedom
void use_sums(const Eigen::MatrixXd& terms, const SeriesLengths& lengths, double correction,
              const IntervalOptions& options, ParameterCovariance* result) {
  const auto use = options.noise == NoiseModel::kCorrelated ? use_kernel : use_bootstrap;
  if (options.lag > 0) return use(terms, lengths, correction, options, result);
  const SummedSeries sums = sums_over(
      terms, lengths, equal_parts(lengths, std::max<Eigen::Index>(1, terms.rows() / kSums)));
  use(sums.terms, sums.lengths, correction, options, result);
  result->lag = in_times(result->lag, terms.rows(), sums.terms.rows());
}

/// Number of pieces of each recording.
SeriesLengths pieces_of_each(const SeriesLengths& lengths, const SeriesLengths& pieces) {
  return sums_over(
             Eigen::MatrixXd(std::accumulate(lengths.begin(), lengths.end(), Eigen::Index{0}), 0),
             lengths, pieces)
      .lengths;
}

/// Sums over pieces with unknowns of their own, to which each contribution of a piece is tied.
void use_pieces(const Eigen::MatrixXd& residuals, const Eigen::MatrixXd& jacobian,
                const Eigen::MatrixXd& root, const SeriesLengths& lengths,
                const SeriesLengths& pieces, const IntervalOptions& options,
                ParameterCovariance* result) {
  const auto count = static_cast<double>(pieces.size());
  const Eigen::MatrixXd terms = contributions_of_pieces(residuals, jacobian, root, pieces);
  result->degrees = count - 1.0;
  if (options.noise == NoiseModel::kBootstrap)
    use_bootstrap(terms, pieces_of_each(lengths, pieces), result->degrees / count, options, result);
  else if (to_signed(pieces.size()) >= kPiecesOfKernel)
    use_kernel(terms, pieces_of_each(lengths, pieces), result->degrees / count, options, result);
  else
    use_independent(terms, result->degrees / count, options, result);
  result->lag = in_times(result->lag, residuals.rows(), to_signed(pieces.size()));
}

/// With the dependent parameters held, an independent one stands for its combination with them.
void mark_undetermined(ParameterCovariance* result) {
  result->combination_deviation = result->covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  result->combination_below = result->below;
  result->combination_above = result->above;
  for (Eigen::Index k = 0; k < result->below.size(); ++k) {
    if (result->identifiability.is_determined[to_index(k)]) continue;
    result->covariance.row(k).setConstant(kUnknown);
    result->covariance.col(k).setConstant(kUnknown);
    result->covariance(k, k) = result->below[k] = result->above[k] = kInfinite;
  }
}

// No long double, whose width differs from platform to platform.
namespace policies = boost::math::policies;
using Policy = policies::policy<policies::promote_double<false>>;

/// t > 0 that is exceeded with probability `tail` below 1/2.
double student_exceeded_with(double tail, double degrees) {
  constexpr double kNormalFrom = 1e8;
  if (degrees >= kNormalFrom) return std::sqrt(2.0) * boost::math::erfc_inv(2.0 * tail, Policy());
  return quantile(complement(boost::math::students_t_distribution<double, Policy>(degrees), tail));
}

}  // namespace

Eigen::MatrixXd ParameterCovariance::correlation() const {
  const Eigen::VectorXd deviations = covariance.diagonal().cwiseSqrt();
  Eigen::MatrixXd result =
      deviations.cwiseInverse().asDiagonal() * covariance * deviations.cwiseInverse().asDiagonal();
  result.diagonal().setOnes();
  return result;
}

ParameterCovariance predicted_covariance(const Eigen::MatrixXd& jacobian, Eigen::Index rows,
                                         double level) {
  ParameterCovariance result;
  const Eigen::MatrixXd R = upper_factor(jacobian);
  result.identifiability = find_identifiable(R);
  result.degrees = std::max(1.0, static_cast<double>(rows - result.identifiability.rank));
  result.residual_variance = 1.0;
  const Eigen::MatrixXd root = root_of_inverse(R, result.identifiability);
  result.covariance = root * root.transpose();
  set_symmetric_intervals(level, &result);
  mark_undetermined(&result);
  return result;
}

ParameterCovariance parameter_covariance(const Eigen::MatrixXd& residuals,
                                         const Eigen::MatrixXd& jacobian,
                                         const SeriesLengths& lengths,
                                         const IntervalOptions& options,
                                         const EliminatedUnknowns& eliminated) {
  ParameterCovariance result;
  const Eigen::MatrixXd R = upper_factor(jacobian);
  result.identifiability = find_identifiable(R);
  const auto rows = static_cast<double>(residuals.size() - eliminated.left_out);
  const Eigen::Index rank = result.identifiability.rank;
  result.degrees = std::max(1.0, rows - static_cast<double>(rank + eliminated.count));
  result.residual_variance = residuals.squaredNorm() / result.degrees;
  const Eigen::MatrixXd root = root_of_inverse(R, result.identifiability),
                        inverse = root * root.transpose();
  if (options.noise == NoiseModel::kWhite) {
    result.covariance = result.residual_variance * inverse;
    set_symmetric_intervals(options.level, &result);
  } else if (options.lag == 0 && to_signed(eliminated.pieces.size()) - rank >= kLeastDegrees) {
    use_pieces(residuals, jacobian, root, lengths, eliminated.pieces, options, &result);
  } else {
    use_sums(contributions(residuals, jacobian, inverse), lengths, rows / result.degrees, options,
             &result);
  }
  mark_undetermined(&result);
  return result;
}

double student_quantile(double p, double degrees) {
  if (p == 0.5) return 0.0;
  return p > 0.5 ? student_exceeded_with(1.0 - p, degrees) : -student_exceeded_with(p, degrees);
}

double interval_factor(double level, double degrees) {
  return student_exceeded_with(0.5 * (1.0 - level), degrees);
}

double chi_squared_tail(double x, double degrees) {
  return boost::math::gamma_q(0.5 * degrees, 0.5 * x, Policy());
}

}  // namespace codesign
