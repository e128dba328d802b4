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
#include "statistics/kernel_moments.h"
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

/// What parts of the recordings contribute to the error of the parameters.
struct Contributions {
  Eigen::MatrixXd terms;  ///< parts x p
  SeriesLengths lengths;  ///< parts of each recording
  /// kernel_moments(), which may take `terms_of_each` parts as one
  SeriesLengths parts, lengths_in_parts;
  std::vector<Eigen::MatrixXd> maps;
  Eigen::Index terms_of_each = 1;
};

/// A fit with J = Q L^-1 on its rank: residuals, Q and L = root_of_inverse().
struct LinearizedFit {
  const Eigen::MatrixXd &residuals, &Q, &root;

  /// Q_i^T r_i of rows from `begin` on.
  Eigen::VectorXd scores(Eigen::Index begin, Eigen::Index count) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(Q.cols());
    for (Eigen::Index output = 0; output < residuals.cols(); ++output)
      sum += block(output, begin, count).transpose() * residuals.col(output).segment(begin, count);
    return sum;
  }
  Eigen::Block<const Eigen::MatrixXd> block(Eigen::Index output, Eigen::Index begin,
                                            Eigen::Index count) const {
    return Q.block(output * residuals.rows() + begin, 0, count, Q.cols());
  }
};

/// Number of pieces of each recording.
SeriesLengths pieces_of_each(const SeriesLengths& lengths, const SeriesLengths& pieces) {
  return sums_over(
             Eigen::MatrixXd(std::accumulate(lengths.begin(), lengths.end(), Eigen::Index{0}), 0),
             lengths, pieces)
      .lengths;
}

/// Sums over parts of (J^T J)^-1 J^T r.
Contributions contributions_of_parts(const LinearizedFit& fit, const SeriesLengths& lengths,
                                     const SeriesLengths& parts) {
  const SeriesLengths of_each = pieces_of_each(lengths, parts);
  Contributions result{Eigen::MatrixXd(to_signed(parts.size()), fit.root.rows()),
                       of_each,
                       parts,
                       of_each,
                       {fit.root.transpose()}};
  Eigen::Index begin = 0;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    result.terms.row(to_signed(part)) = (fit.root * fit.scores(begin, parts[part])).transpose();
    begin += parts[part];
  }
  return result;
}

/// The contribution of each piece as the other pieces tell it, theory (43a): a piece with much of
/// the information draws the fit, so that its residuals are too small.
Contributions contributions_of_pieces(const LinearizedFit& fit, const SeriesLengths& lengths,
                                      const SeriesLengths& pieces) {
  const SeriesLengths of_each = pieces_of_each(lengths, pieces);
  Contributions result{
      Eigen::MatrixXd(to_signed(pieces.size()), fit.root.rows()), of_each, pieces, of_each, {}};
  Eigen::Index begin = 0;
  for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
    Eigen::MatrixXd left = Eigen::MatrixXd::Identity(fit.Q.cols(), fit.Q.cols());
    for (Eigen::Index output = 0; output < fit.residuals.cols(); ++output) {
      const Eigen::MatrixXd rows = fit.block(output, begin, pieces[piece]);
      left -= transposed_product(rows, rows);
    }
    const SymmetricEigen eigen = symmetric_eigen(left);
    result.maps.emplace_back(eigen.vectors *
                             eigen.values.cwiseMax(kLeastLeft).cwiseInverse().asDiagonal() *
                             (eigen.vectors.transpose() * fit.root.transpose()));
    result.terms.row(to_signed(piece)) =
        fit.scores(begin, pieces[piece]).transpose() * result.maps.back();
    begin += pieces[piece];
  }
  return result;
}

/// A lag in sums over times, in times.
int in_times(int lag, Eigen::Index times, Eigen::Index sums) {
  return static_cast<int>(
      std::lround(lag * static_cast<double>(times) / static_cast<double>(sums)));
}

void set_symmetric_intervals(double level, ParameterCovariance* result) {
  result->below = result->covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  for (Eigen::Index k = 0; k < result->below.size(); ++k)
    result->below[k] *= interval_factor(level, result->degrees[k]);
  result->above = result->below;
}

/// What makes an estimate right on average if the noise is white.
struct Correction {
  Eigen::VectorXd factors;  ///< of each deviation; zero where the contributions tell no variance
  Eigen::VectorXd white;    ///< the variance to take there, that of white noise; else zero
};

/// Sets the degrees of freedom of an estimate, too. @param lag in terms
Correction correct_by_moments(const LinearizedFit& fit, const Contributions& of, int lag,
                              ParameterCovariance* result) {
  const auto lag_in_parts =
      static_cast<int>(std::lround(lag / static_cast<double>(of.terms_of_each)));
  const KernelMoments moments = kernel_moments(fit.Q, fit.residuals.cols(), of.parts,
                                               of.lengths_in_parts, lag_in_parts, of.maps);
  result->degrees = result->degrees.cwiseMin(moments.degrees);
  const Eigen::Index p = moments.means.size();
  Correction correction{Eigen::VectorXd::Zero(p), Eigen::VectorXd::Zero(p)};
  for (Eigen::Index k = 0; k < p; ++k) {
    const double squares = fit.root.row(k).squaredNorm();
    if (moments.means[k] > 0.0)
      correction.factors[k] = std::sqrt(squares / moments.means[k]);
    else
      correction.white[k] = result->residual_variance * squares;
  }
  return correction;
}

void use_kernel(const LinearizedFit& fit, const Contributions& of, const IntervalOptions& options,
                ParameterCovariance* result) {
  const LongRunCovariance estimate = long_run_covariance(of.terms, of.lengths, options.lag);
  const Correction correct = correct_by_moments(fit, of, estimate.lag, result);
  result->covariance =
      correct.factors.asDiagonal() * estimate.covariance * correct.factors.asDiagonal();
  result->covariance.diagonal() += correct.white;
  result->lag = estimate.lag;
  set_symmetric_intervals(options.level, result);
}

void use_independent(const LinearizedFit& fit, const Contributions& of,
                     const IntervalOptions& options, ParameterCovariance* result) {
  const Correction correct = correct_by_moments(fit, of, 0, result);
  const Eigen::MatrixXd terms = of.terms * correct.factors.asDiagonal();
  result->covariance = terms.transpose() * terms;
  result->covariance.diagonal() += correct.white;
  result->lag = 1;
  set_symmetric_intervals(options.level, result);
}

// The errors of the parameters are distributed like the drawn sums, so that the interval mirrors
// their quantiles. The variance of sums of blocks is nearly that of the kernel as wide as a block,
// in series that are longer.
void use_bootstrap(const LinearizedFit& fit, const Contributions& of,
                   const IntervalOptions& options, ParameterCovariance* result) {
  result->lag =
      block_within(of.lengths, options.lag > 0 ? options.lag : automatic_lag(of.terms, of.lengths));
  const Correction correct = correct_by_moments(fit, of, result->lag - 1, result);
  // Single terms may come from any series; in one of its own, one term would always be drawn.
  const SeriesLengths lengths = result->lag == 1 ? SeriesLengths{of.terms.rows()} : of.lengths;
  const Eigen::MatrixXd draws =
      bootstrap_sums(of.terms, lengths, result->lag, kDraws, kSeed) * correct.factors.asDiagonal();
  result->covariance = draws.transpose() * draws / (kDraws - 1.0);
  result->covariance.diagonal() += correct.white;
  result->below.resize(draws.cols());
  result->above.resize(draws.cols());
  for (Eigen::Index k = 0; k < draws.cols(); ++k) {
    const double factor = interval_factor(options.level, result->degrees[k]),
                 wider = factor / interval_factor(options.level, kInfinite),
                 white = factor * std::sqrt(correct.white[k]);
    result->below[k] =
        wider * empirical_quantile(draws.col(k), 0.5 * (1.0 + options.level)) + white;
    result->above[k] =
        white - wider * empirical_quantile(draws.col(k), 0.5 * (1.0 - options.level));
  }
}

/// The contributions of single times do not matter, only their sums over equal parts of so many
/// times that the rate of the samples does not matter. A lag that is given counts times, of which
/// the moments take as many together.
void use_sums(const LinearizedFit& fit, const SeriesLengths& lengths,
              const IntervalOptions& options, ParameterCovariance* result) {
  const Eigen::Index times = fit.residuals.rows(), size = std::max<Eigen::Index>(1, times / kSums);
  const SeriesLengths parts = equal_parts(lengths, size);
  Contributions sums =
      contributions_of_parts(fit, lengths, options.lag > 0 ? equal_parts(lengths, 1) : parts);
  if (options.lag > 0) {
    sums.parts = parts;
    sums.lengths_in_parts = pieces_of_each(lengths, parts);
    sums.terms_of_each = size;
  }
  const auto use = options.noise == NoiseModel::kCorrelated ? use_kernel : use_bootstrap;
  use(fit, sums, options, result);
  result->lag = in_times(result->lag, times, sums.terms.rows());
}

/// Sums over pieces with unknowns of their own, to which each contribution of a piece is tied.
void use_pieces(const LinearizedFit& fit, const SeriesLengths& lengths, const SeriesLengths& pieces,
                const IntervalOptions& options, ParameterCovariance* result) {
  const Contributions sums = contributions_of_pieces(fit, lengths, pieces);
  auto use = use_bootstrap;
  if (options.noise == NoiseModel::kCorrelated)
    use = to_signed(pieces.size()) >= kPiecesOfKernel ? use_kernel : use_independent;
  use(fit, sums, options, result);
  result->lag = in_times(result->lag, fit.residuals.rows(), to_signed(pieces.size()));
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
  result.degrees.setConstant(
      jacobian.cols(), std::max(1.0, static_cast<double>(rows - result.identifiability.rank)));
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
  const Eigen::MatrixXd& counted = eliminated.counted;
  const bool all_count = counted.size() == 0;
  const double rows = all_count ? static_cast<double>(residuals.size()) : counted.sum(),
               squares = all_count ? residuals.squaredNorm()
                                   : residuals.cwiseProduct(counted).squaredNorm();
  const Eigen::Index rank = result.identifiability.rank;
  const double left = std::max(1.0, rows - static_cast<double>(rank + eliminated.count));
  result.degrees.setConstant(jacobian.cols(), left);
  result.residual_variance = squares / left;
  const Eigen::MatrixXd root = root_of_inverse(R, result.identifiability);
  if (options.noise == NoiseModel::kWhite) {
    result.covariance = result.residual_variance * root * root.transpose();
    set_symmetric_intervals(options.level, &result);
  } else {
    const Eigen::MatrixXd Q = jacobian * root;
    const LinearizedFit fit{residuals, Q, root};
    if (options.lag == 0 && to_signed(eliminated.pieces.size()) - rank >= kLeastDegrees)
      use_pieces(fit, lengths, eliminated.pieces, options, &result);
    else
      use_sums(fit, lengths, options, &result);
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
