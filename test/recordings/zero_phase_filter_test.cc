// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/zero_phase_filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

constexpr double kPi = 3.14159265358979323846;

Eigen::VectorXd filtered(const ZeroPhaseFilter& filter, Eigen::VectorXd samples) {
  ZeroPhaseFilter::Workspace workspace;
  filter.apply(samples, &workspace);
  return samples;
}

// scipy 1.10.1: b, a = butter(order, cutoff / (rate / 2)); filtfilt(b, a, x) with x[k] = sin(0.3 k)
// + 0.25 (k % 3 - 1) + 0.01 k^2 for k = 0 ... 39, at k = 0, 1, 7, 20, 38, 39.
struct ScipyCase {
  int order;
  double cutoff;  // at a rate of 2 Hz
  std::array<double, 6> values;
};

class AgainstScipy : public testing::TestWithParam<ScipyCase> {};

TEST_P(AgainstScipy, GivesTheNumbersOfFiltfilt) {
  Eigen::VectorXd samples(40);
  for (int k = 0; k < 40; ++k) samples[k] = std::sin(0.3 * k) + 0.25 * (k % 3 - 1) + 0.01 * k * k;
  const Eigen::VectorXd result =
      filtered(ZeroPhaseFilter(GetParam().order, GetParam().cutoff, 2.0), samples);
  const std::array<int, 6> places = {0, 1, 7, 20, 38, 39};
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_NEAR(result[places[i]], GetParam().values[i], 1e-12) << places[i];
}

INSTANTIATE_TEST_SUITE_P(
    Orders, AgainstScipy,
    testing::Values(ScipyCase{4,
                              0.2,
                              {-0.2538471020794801, 0.16931379811248304, 1.3608506724312512,
                               3.718482485610147, 13.447409120748162, 14.200916342451647}},
                    ScipyCase{3,
                              0.35,
                              {-0.2497949541239231, 0.24785700664962448, 1.3505490937070033,
                               3.7211364852208493, 13.479273763754936, 14.196995286568008}},
                    ScipyCase{1,
                              0.5,
                              {-0.25, 0.30392072167942863, 1.3389323861817735, 3.794324340372215,
                               13.608701694136906, 14.198016416080968}},
                    ScipyCase{2,
                              0.02,
                              {0.8557094934180653, 1.0129528781513428, 2.036980583268774,
                               4.494217713052, 6.861256368057647, 6.91428728909751}}));

TEST(ZeroPhaseFilter, HasHalfTheAmplitudeAtTheCutoffAndNoDelay) {
  const double rate = 1000.0, cutoff = 20.0;
  const ZeroPhaseFilter filter(4, cutoff, rate);
  for (const double frequency : {2.0, 20.0, 60.0}) {
    Eigen::VectorXd samples(4001);
    for (int k = 0; k <= 4000; ++k)
      samples[k] = std::cos(2.0 * kPi * frequency * (k - 2000) / rate);
    const Eigen::VectorXd result = filtered(filter, samples);
    // |H|^2 of the bilinear transform: 1 / (1 + (tan(pi f / rate) / tan(pi fc / rate))^(2 n)).
    const double ratio = std::tan(kPi * frequency / rate) / std::tan(kPi * cutoff / rate);
    const double gain = 1.0 / (1.0 + std::pow(ratio, 8.0));
    for (int k = 1950; k <= 2050; ++k)
      ASSERT_NEAR(result[k], gain * samples[k], 1e-9) << frequency << " Hz";
  }
}

TEST(ZeroPhaseFilter, PassesLinesUnchanged) {
  const ZeroPhaseFilter filter(5, 3.0, 100.0);
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(900, -1.0, 2.0);
  EXPECT_LT((filtered(filter, line) - line).segment(400, 100).lpNorm<Eigen::Infinity>(), 1e-6);
  const Eigen::VectorXd constant = Eigen::VectorXd::Constant(filter.least_samples(), 7.0);
  EXPECT_LT((filtered(filter, constant) - constant).lpNorm<Eigen::Infinity>(), 1e-13);
}

TEST(ZeroPhaseFilter, IsLinearAndTreatsColumnsAlike) {
  const ZeroPhaseFilter filter(4, 5.0, 100.0);
  Eigen::MatrixXd columns = Eigen::MatrixXd::NullaryExpr(
      200, 3, [](Eigen::Index i, Eigen::Index j) { return std::sin(0.1 * double(i * (j + 1))); });
  columns.col(2) = 2.0 * columns.col(0) - columns.col(1);
  const Eigen::VectorXd first = filtered(filter, columns.col(0));
  ZeroPhaseFilter::Workspace workspace;
  filter.apply_to_columns(columns, &workspace);
  EXPECT_EQ(columns.col(0), first);
  EXPECT_LT((columns.col(2) - 2.0 * columns.col(0) + columns.col(1)).norm(), 1e-12);
}

TEST(ZeroPhaseFilter, KeepsItsDigitsAtLowCutoffs) {
  const ZeroPhaseFilter filter(8, 1e-3, 1.0);
  Eigen::VectorXd wave(40000);
  for (int k = 0; k < 40000; ++k) wave[k] = std::cos(2.0 * kPi * 1e-4 * (k - 20000));
  const Eigen::VectorXd result = filtered(filter, wave);
  EXPECT_NEAR(result[20000], 1.0, 1e-9);
}

}  // namespace
}  // namespace codesign
