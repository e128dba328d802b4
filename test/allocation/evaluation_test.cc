// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// A worker that has evaluated one design evaluates others without allocating anything but the
// vectors of its results.
#include "allocation/count.h"
#include "engine/thread_engine.h"
#include "integration/rounded_linkages.h"
#include "sensitivity/gradient_cases.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

/// Cases of the gradient and further ones: `chain` has an expression for nearly every number;
/// `slider_crank`, `slider_crank_haug` and `governor` are closed loops to be assembled; `four_bar`
/// and the rounded ones have redundant rows, which the latter drop; `servo`, `feed_axis` (sampled)
/// and `arm_limits` (way-points, watched signals) have controllers.
std::vector<GradientCase> evaluation_cases() {
  std::vector<GradientCase> cases = gradient_cases();
  for (const char* name : {"slider_crank", "feed_axis", "arm_limits", "vendor_arm"})
    cases.push_back(shipped_case(name, 0.05));
  cases.push_back(
      from_texts("two_rounded_four_bars", rounded::two_four_bars(),
                 rounded::study(rounded::two_four_bars_start(), "j1_a/velocity", 0.05, 1e-6)));
  cases.push_back(
      from_texts("rounded_parallel_arms", rounded::parallel_arms(),
                 rounded::study(rounded::parallel_arms_start(), "m1/velocity", 0.02, 1e-6)));
  cases.push_back(from_texts("rounded_bennett", rounded::bennett(),
                             rounded::study(rounded::bennett_start(), "t1/velocity", 0.02, 1e-6)));
  return cases;
}

/// The number of vectors and matrices in a result that hold something: each is one allocation.
std::int64_t vectors_of(const Evaluation& e) {
  std::int64_t count = 0;
  for (const Eigen::Index size :
       {e.gradient.size(), e.jacobian_root.size(), e.extremes.values.size(),
        e.extremes.times.size(), e.extremes.gradients.size()})
    if (size > 0) ++count;
  return count;
}

/// The parameters of the k-th design: the tuned ones are k permille above their start values.
std::vector<double> design(const CompiledSystem& system, int k) {
  std::vector<double> parameters = system.parameters();
  for (int tuned : system.study().tuned)
    parameters[static_cast<std::size_t>(tuned)] *= 1.0 + 1e-3 * k;
  return parameters;
}

/// A case, and the integrator and the gradient by which it is evaluated.
struct Way {
  const char *name, *method, *gradient;
  IntegratorKind integrator;
};
constexpr Way kWays[] = {{"rodas4", "rodas4", "direct", IntegratorKind::kRosenbrock},
                         {"rodas5p", "rodas5p", "direct", IntegratorKind::kRosenbrock},
                         {"adjoint", "rodas4", "adjoint", IntegratorKind::kRosenbrock},
                         {"idas", "rodas4", "direct", IntegratorKind::kIdas}};
using CaseAndWay = std::tuple<std::size_t, Way>;

class WarmWorker : public ::testing::TestWithParam<CaseAndWay> {
 protected:
  void expect_no_allocation(Derivatives derivatives) {
    GradientCase test = evaluation_cases().at(std::get<0>(GetParam()));
    const Way& way = std::get<1>(GetParam());
    test.study.solver.integrator = way.integrator;
    const auto system = test.compile(way.method, way.gradient);
    EvaluationWorker worker;
    for (int k = 0; k < 3; ++k) {
      const std::vector<double> parameters = design(*system, k);
      const std::int64_t before = allocations();
      const Evaluation evaluation = worker.compute(system, parameters, derivatives, nullptr);
      const std::int64_t count = allocations() - before;
      ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
      ASSERT_TRUE(evaluation.warnings.empty()) << evaluation.warnings.front().message;
      if (k > 0) {
        EXPECT_EQ(count, vectors_of(evaluation)) << "design " << k;
      }
    }
  }
};

TEST_P(WarmWorker, AsksForNoMemoryForAnObjective) { expect_no_allocation(Derivatives::kNone); }

TEST_P(WarmWorker, AsksForAGradientOnly) { expect_no_allocation(Derivatives::kGradient); }

TEST_P(WarmWorker, AsksForAGradientAndARootOnly) {
  expect_no_allocation(Derivatives::kGaussNewton);
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, WarmWorker,
                         ::testing::Combine(::testing::Range(std::size_t{0},
                                                             evaluation_cases().size()),
                                            ::testing::ValuesIn(kWays)),
                         [](const auto& instance) {
                           return evaluation_cases().at(std::get<0>(instance.param)).name + "_" +
                                  std::get<1>(instance.param).name;
                         });

// The public door, which takes the tuned parameters alone.
TEST(WarmEvaluator, AsksForAGradientOnly) {
  const auto system = gradient_cases().front().compile("rodas4", "direct");
  Evaluator evaluator = evaluator_of(system);
  Eigen::VectorXd rho(static_cast<Eigen::Index>(system->study().tuned.size()));
  for (int k = 0; k < 3; ++k) {
    const std::vector<double> parameters = design(*system, k);
    for (Eigen::Index p = 0; p < rho.size(); ++p)
      rho[p] =
          parameters[static_cast<std::size_t>(system->study().tuned[static_cast<std::size_t>(p)])];
    const std::int64_t before = allocations();
    const Evaluation evaluation = evaluator.evaluate(rho, Derivatives::kGradient);
    const std::int64_t count = allocations() - before;
    ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
    if (k > 0) {
      EXPECT_EQ(count, 1) << "design " << k;
    }
  }
}

}  // namespace
}  // namespace codesign
