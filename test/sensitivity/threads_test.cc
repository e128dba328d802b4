// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Several designs at once, each on a thread with a workspace of its own, all with one
// CompiledSystem.
#include <thread>

#include "sensitivity/gradient_cases.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

constexpr std::size_t kThreads = 4;
constexpr int kDesigns = 3;  // per thread

std::vector<Evaluation> evaluate(const std::shared_ptr<const CompiledSystem>& system,
                                 std::size_t thread) {
  std::vector<Evaluation> results;
  Evaluator evaluator = evaluator_of(system);
  const std::vector<double> parameters = system->parameters();
  for (int design = 0; design < kDesigns; ++design) {
    Eigen::VectorXd rho(static_cast<Eigen::Index>(system->study().tuned.size()));
    for (Eigen::Index k = 0; k < rho.size(); ++k)
      rho[k] =
          parameters[static_cast<std::size_t>(system->study().tuned[static_cast<std::size_t>(k)])] *
          (1.0 + 0.01 * static_cast<double>(thread) + 0.002 * design);
    results.push_back(evaluator.evaluate(rho, true));
  }
  return results;
}

void expect_same(const std::shared_ptr<const CompiledSystem>& system) {
  std::vector<std::vector<Evaluation>> together(kThreads);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < kThreads; ++k)
    threads.emplace_back([&, k] { together[k] = evaluate(system, k); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < kThreads; ++k) {
    const std::vector<Evaluation> alone = evaluate(system, k);
    for (std::size_t design = 0; design < alone.size(); ++design) {
      ASSERT_TRUE(alone[design].status.ok()) << alone[design].status.cause;
      EXPECT_EQ(together[k][design].objective, alone[design].objective);
      EXPECT_EQ(together[k][design].gradient, alone[design].gradient);
      EXPECT_EQ(together[k][design].statistics.steps, alone[design].statistics.steps);
    }
  }
}

TEST(Threads, DesignsEvaluatedAtOnceAreTheSameToTheLastBit) {
  for (const char* gradient : {"direct", "adjoint"}) {
    expect_same(shipped_case("slider_crank_haug", 0.1).compile("rodas4", gradient));
    expect_same(from_texts("servo", double_pendulum(pin_friction()), servo_study("{}"))
                    .compile("rodas5p", gradient));
  }
}

TEST(Threads, SoAreThoseOfIdas) { expect_same(servo("{integrator: idas}")); }

}  // namespace
}  // namespace codesign
