// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/tableau.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "description/solver_names.h"
#include "integration/tableaus.h"

namespace codesign {
namespace {

/// One step on y' = f(y), f = -y^2 + sin-like cubic: scalar, autonomous, with its exact derivative.
double f(double y) { return -y * y + 0.3 * y * y * y; }
double f_y(double y) { return -2.0 * y + 0.9 * y * y; }

double integrate(const RosenbrockTableau& tableau, int steps, double* dense_middle) {
  const double h = 1.0 / steps;
  double y = 1.0;
  for (int n = 0; n < steps; ++n) {
    std::vector<double> u;
    const double J = f_y(y);
    for (std::size_t i = 0; i < static_cast<std::size_t>(tableau.stages); ++i) {
      double stage = y, sum = 0.0;
      for (std::size_t j = 0; j < i; ++j) {
        stage += tableau.a[i][j] * u[j];
        sum += tableau.c[i][j] / h * u[j];
      }
      u.push_back(tableau.is_explicit() ? h * f(stage)
                                        : (f(stage) + sum) / (1.0 / (h * tableau.gamma) - J));
    }
    double end = y;
    for (std::size_t j = 0; j < u.size(); ++j) end += tableau.weights[j] * u[j];
    if (n == 0) {
      *dense_middle = 0.5 * (y + end);
      for (int k = 0; k < tableau.dense_terms; ++k)
        for (std::size_t j = 0; j < u.size(); ++j)
          *dense_middle +=
              0.25 * std::pow(0.5, k) * tableau.dense[static_cast<std::size_t>(k)][j] * u[j];
    }
    y = end;
  }
  return y;
}

class Tableau : public ::testing::TestWithParam<const RosenbrockTableau*> {};

TEST_P(Tableau, ConvergesAtItsOrder) {
  const RosenbrockTableau& tableau = *GetParam();
  double unused = 0.0;
  const double exact = integrate(rodas5p(), 4096, &unused);
  const double coarse = std::abs(integrate(tableau, 8, &unused) - exact),
               fine = std::abs(integrate(tableau, 16, &unused) - exact);
  EXPECT_NEAR(std::log2(coarse / fine), tableau.order, 0.5);
}

TEST_P(Tableau, DenseOutputIsOneOrderLess) {
  const RosenbrockTableau& tableau = *GetParam();
  double middle[2], exact[2];
  const int steps[2] = {8, 16};
  for (int k = 0; k < 2; ++k) {
    integrate(tableau, steps[k], &middle[k]);
    // The exact solution after half a step: 1/(2 steps).
    const int fine = 1024;
    double y = 1.0;
    const double h = 0.5 / steps[k] / fine;
    for (int n = 0; n < fine; ++n) {
      const double k1 = f(y), k2 = f(y + 0.5 * h * k1), k3 = f(y + 0.5 * h * k2),
                   k4 = f(y + h * k3);
      y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    exact[k] = y;
  }
  // Local error of one step: order + 1.
  const double rate = std::log2(std::abs(middle[0] - exact[0]) / std::abs(middle[1] - exact[1]));
  EXPECT_GT(rate, tableau.order - 0.4);
}

TEST_P(Tableau, HasItsLastStageAtTheEnd) {
  const RosenbrockTableau& t = *GetParam();
  const auto last = static_cast<std::size_t>(t.stages) - 1;
  for (std::size_t j = 0; j < last; ++j) EXPECT_EQ(t.weights[j], t.a[last][j]);
  EXPECT_EQ(t.weights[last], t.is_explicit() ? 0.0 : 1.0);
  EXPECT_EQ(t.alpha[last], 1.0);
}

TEST_P(Tableau, SlopesAndCurvaturesOfTheDenseOutputAreItsDerivatives) {
  const RosenbrockTableau& t = *GetParam();
  const double theta = 0.3, step = 1e-5;
  const auto before = dense_weights(t, theta - step), behind = dense_weights(t, theta + step),
             at = dense_weights(t, theta);
  const auto slopes = dense_weight_slopes(t, theta), curvatures = dense_weight_curvatures(t, theta);
  for (std::size_t j = 0; j < static_cast<std::size_t>(t.stages); ++j) {
    EXPECT_NEAR(slopes[j], (behind[j] - before[j]) / (2.0 * step), 1e-7);
    EXPECT_NEAR(curvatures[j], (behind[j] - 2.0 * at[j] + before[j]) / (step * step), 1e-3);
  }
}

// The rates of the dense output begin and end with those of the first and the last stage.
TEST(Dopri5, RatesOfTheDenseOutputAreThoseOfItsEnds) {
  const auto first = rate_weights(dopri5(), 0.0), last = rate_weights(dopri5(), 1.0);
  for (std::size_t j = 0; j < 7; ++j) {
    EXPECT_NEAR(first[j], j == 0 ? 1.0 : 0.0, 1e-14);
    EXPECT_NEAR(last[j], j == 6 ? 1.0 : 0.0, 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Tableau, ::testing::ValuesIn(all_tableaus()), tableau_name);

TEST(TableauNames, AreThoseOfStudies) {
  for (const char* name : kRosenbrockMethodNames) {
    const bool is_automatic = method_named(name) == RosenbrockMethod::kAuto;
    EXPECT_STREQ(rosenbrock_tableau(method_named(name)).name, is_automatic ? "dopri5" : name);
    EXPECT_EQ(most_stages(method_named(name)),
              is_automatic ? 8 : rosenbrock_tableau(method_named(name)).stages);
  }
}

}  // namespace
}  // namespace codesign
