// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/curvature.h"

#include <gtest/gtest.h>

#include "integration/servo.h"

namespace codesign {
namespace {

using C = std::complex<double>;
constexpr double kStep = 1e-30;
constexpr int kPairs = 3;

/// The servo away from its constraints, where nothing vanishes by chance.
class CurvatureTest : public ::testing::Test {
 protected:
  CurvatureTest() : at(system->layout()), curvature(*system), real(*system), complex(*system) {
    const std::vector<double> parameters = system->parameters();
    curvature.set_design(parameters);
    real.set_design(parameters);
    complex.set_design(std::vector<C>(parameters.begin(), parameters.end()));
    point.resize(system->layout());
    double next = 0.3;
    const auto fill = [&next](VectorX<double>* x) {
      for (Eigen::Index k = 0; k < x->size(); ++k) (*x)[k] = std::sin(next += 1.7);
    };
    for (VectorX<double>* part : {&point.q, &point.v, &point.s, &point.z}) fill(part);
    for (int k = 0; k < kPairs; ++k) {
      u.push_back(VectorX<double>::Zero(at.size()));
      mu.push_back(VectorX<double>::Zero(at.z_size + 1));
      fill(&u.back());
      fill(&mu.back());
      curvature.set(k, u.back(), mu.back());
    }
  }

  /// sum_k mu_k^T G_y u_k, from the patterns' entries.
  template <class T>
  T theta(const Linearization<T>& d) const {
    T sum(0.0);
    const auto add = [&](const Sparsity& pattern, const std::vector<T>& values, int first) {
      for (int row = 0; row < pattern.rows; ++row)
        for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
          for (std::size_t k = 0; k < kPairs; ++k)
            sum += mu[k][row] * u[k][first + pattern.column(e)] * values[static_cast<std::size_t>(e)];
    };
    add(system->patterns().position, d.position, at.x());
    add(system->patterns().velocity, d.velocity, at.v());
    add(system->patterns().rate, d.rate, at.z());
    return sum;
  }

  double derivative(int column) {
    State<C> state;
    cast_state(point, &state);
    VectorX<C>* parts[] = {&state.q, &state.s, &state.v, &state.z};
    for (VectorX<C>* part : parts) {
      if (column >= 0 && column < part->size()) (*part)[column] += C(0.0, kStep);
      column -= static_cast<int>(part->size());
    }
    Linearization<C> d;
    d.resize(system->patterns());
    complex.linearize(state, &d);
    return theta(d).imag() / kStep;
  }

  const std::shared_ptr<const CompiledSystem> system = servo("{}");
  const IncrementLayout at;
  Curvature<8> curvature;
  Equations<double> real;
  Equations<C> complex;
  State<double> point;
  std::vector<VectorX<double>> u, mu;
};

TEST_F(CurvatureTest, StateGradientIsThatOfTheForms) {
  VectorX<double> gradient = VectorX<double>::Zero(at.size());
  curvature.add_state_gradient(point, &gradient);
  EXPECT_GT(gradient.norm(), 1.0);
  for (int column = 0; column < at.psi(); ++column)
    EXPECT_NEAR(gradient[column], derivative(column), 1e-11 * gradient.cwiseAbs().maxCoeff()) << column;
}

TEST_F(CurvatureTest, WeightsTimesEntriesAreTheForms) {
  ByVariable<std::vector<double>> weights;
  Linearization<double> d;
  d.resize(system->patterns());
  real.linearize(point, &d);
  weights.position.resize(d.position.size());
  weights.velocity.resize(d.velocity.size());
  weights.rate.resize(d.rate.size());
  curvature.add_weights(&weights);
  double sum = 0.0;
  for (std::size_t e = 0; e < d.position.size(); ++e) sum += weights.position[e] * d.position[e];
  for (std::size_t e = 0; e < d.velocity.size(); ++e) sum += weights.velocity[e] * d.velocity[e];
  for (std::size_t e = 0; e < d.rate.size(); ++e) sum += weights.rate[e] * d.rate[e];
  EXPECT_NEAR(sum, theta(d), 1e-12 * std::abs(sum));
}

TEST_F(CurvatureTest, WithoutPairsThereIsNone) {
  VectorX<double> gradient = VectorX<double>::Zero(at.size());
  curvature.clear();
  curvature.add_state_gradient(point, &gradient);
  EXPECT_EQ(gradient.norm(), 0.0);
}

}  // namespace
}  // namespace codesign
