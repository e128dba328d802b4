// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/kernel_moments.h"

#include <algorithm>
#include <utility>

#include "math/arrays.h"
#include "math/dense.h"

namespace codesign {
namespace {

/// The covariance of the contributions psi of one parameter with white noise:
/// diag(own) - shared shared^T.
struct ContributionCovariance {
  Eigen::VectorXd own;
  Eigen::MatrixXd shared;  ///< parts x rank
};

/// Q_i^T Q_i of each part, over all outputs.
std::vector<Eigen::MatrixXd> products_of_parts(const Eigen::MatrixXd& Q, Eigen::Index outputs,
                                               const SeriesLengths& parts) {
  const Eigen::Index rows = Q.rows() / outputs;
  std::vector<Eigen::MatrixXd> products;
  products.reserve(parts.size());
  Eigen::Index begin = 0;
  for (const Eigen::Index count : parts) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(Q.cols(), Q.cols());
    for (Eigen::Index output = 0; output < outputs; ++output) {
      const Eigen::MatrixXd block = Q.middleRows(output * rows + begin, count);
      sum += transposed_product(block, block);
    }
    products.push_back(std::move(sum));
    begin += count;
  }
  return products;
}

/// @param products of products_of_parts()
ContributionCovariance covariance_of_parts(const std::vector<Eigen::MatrixXd>& products,
                                           const std::vector<Eigen::MatrixXd>& maps,
                                           Eigen::Index parameter) {
  const auto parts = to_signed(products.size());
  ContributionCovariance result{Eigen::VectorXd(parts),
                                Eigen::MatrixXd(parts, maps.front().rows())};
  for (Eigen::Index part = 0; part < parts; ++part) {
    const Eigen::VectorXd map = maps[maps.size() > 1 ? to_index(part) : 0].col(parameter),
                          shared = products[to_index(part)] * map;
    result.shared.row(part) = shared.transpose();
    result.own[part] = shared.dot(map);
  }
  return result;
}

/// sum_ij w_ij^2 own_i own_j with the weights of the Bartlett kernel.
double squared_weights(const Eigen::VectorXd& own, const SeriesLengths& lengths, int lag) {
  double sum = own.squaredNorm();
  const Eigen::Index most =
      std::min<Eigen::Index>(lag, *std::max_element(lengths.begin(), lengths.end()) - 1);
  for (Eigen::Index distance = 1; distance <= most; ++distance) {
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
  // Of the sum of variances: less is rounding.
  constexpr double kLeastMean = 1e-10;
  const Eigen::Index p = maps.front().cols();
  const std::vector<Eigen::MatrixXd> products = products_of_parts(Q, outputs, parts);
  KernelMoments moments{Eigen::VectorXd::Zero(p), Eigen::VectorXd::Ones(p)};
  for (Eigen::Index k = 0; k < p; ++k) {
    const ContributionCovariance C = covariance_of_parts(products, maps, k);
    const Eigen::MatrixXd smoothed = bartlett_product(C.shared, lengths, lag),
                          both = C.shared.transpose() * smoothed;
    const double mean = C.own.sum() - both.trace(),
                 squares = squared_weights(C.own, lengths, lag) -
                           2.0 * C.own.dot(smoothed.rowwise().squaredNorm()) + both.squaredNorm();
    if (!(mean > kLeastMean * C.own.sum()) || !(squares > 0.0)) continue;
    moments.means[k] = mean;
    moments.degrees[k] = std::max(1.0, mean * mean / squares);
  }
  return moments;
}

}  // namespace codesign
