// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/kernel_moments.h"

#include <algorithm>

#include "math/arrays.h"

namespace codesign {
namespace {

/// The covariance of the contributions psi of one parameter with white noise:
/// diag(own) - shared shared^T.
struct ContributionCovariance {
  Eigen::VectorXd own;
  Eigen::MatrixXd shared;  ///< parts x rank
};

ContributionCovariance covariance_of_parts(const Eigen::MatrixXd& Q, Eigen::Index outputs,
                                           const SeriesLengths& parts,
                                           const std::vector<Eigen::MatrixXd>& maps,
                                           Eigen::Index parameter) {
  const Eigen::Index rows = Q.rows() / outputs;
  ContributionCovariance result{Eigen::VectorXd::Zero(to_signed(parts.size())),
                                Eigen::MatrixXd::Zero(to_signed(parts.size()), Q.cols())};
  Eigen::Index begin = 0;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const Eigen::VectorXd map = maps[maps.size() > 1 ? part : 0].col(parameter);
    for (Eigen::Index output = 0; output < outputs; ++output) {
      const auto block = Q.middleRows(output * rows + begin, parts[part]);
      const Eigen::VectorXd weights = block * map;
      result.own[to_signed(part)] += weights.squaredNorm();
      result.shared.row(to_signed(part)) += weights.transpose() * block;
    }
    begin += parts[part];
  }
  return result;
}

/// sum_ij w_ij^2 own_i own_j with the weights of the Bartlett kernel.
double squared_weights(const Eigen::VectorXd& own, const SeriesLengths& lengths, int lag) {
  double sum = own.squaredNorm();
  for (Eigen::Index distance = 1; distance <= lag; ++distance) {
    const double weight = 1.0 - static_cast<double>(distance) / (lag + 1.0);
    double products = 0.0;
    Eigen::Index begin = 0;
    for (const Eigen::Index length : lengths) {
      const Eigen::Index pairs = std::max<Eigen::Index>(0, length - distance);
      products += own.segment(begin, pairs).dot(own.segment(begin + length - pairs, pairs));
      begin += length;
    }
    sum += 2.0 * weight * weight * products;
  }
  return sum;
}

}  // namespace

// With C = D - G G^T, D diagonal: tr(W C) = tr D - tr(G^T W G) and
// tr(W C W C) = sum w^2 D D - 2 tr((W G)^T D (W G)) + |G^T W G|^2.
KernelMoments kernel_moments(const Eigen::MatrixXd& Q, Eigen::Index outputs,
                             const SeriesLengths& parts, const SeriesLengths& lengths, int lag,
                             const std::vector<Eigen::MatrixXd>& maps) {
  const Eigen::Index p = maps.front().cols();
  KernelMoments moments{Eigen::VectorXd::Zero(p), Eigen::VectorXd::Ones(p)};
  for (Eigen::Index k = 0; k < p; ++k) {
    const ContributionCovariance C = covariance_of_parts(Q, outputs, parts, maps, k);
    const Eigen::MatrixXd smoothed = bartlett_product(C.shared, lengths, lag),
                          both = C.shared.transpose() * smoothed;
    const double mean = C.own.sum() - both.trace(),
                 squares = squared_weights(C.own, lengths, lag) -
                           2.0 * C.own.dot(smoothed.rowwise().squaredNorm()) + both.squaredNorm();
    if (!(mean > 0.0) || !(squares > 0.0)) continue;
    moments.means[k] = mean;
    moments.degrees[k] = std::max(1.0, mean * mean / squares);
  }
  return moments;
}

}  // namespace codesign
