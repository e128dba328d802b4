// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/equation_variant.h"

#include <gtest/gtest.h>

#include <thread>

#include "assembly/make_system.h"
#include "cases/shipped.h"
#include "equations/compiled.h"
#include "integration/servo.h"

namespace codesign {
namespace {

#define SKIP_WITHOUT_CODE() \
  if (!ValueCode::is_available()) GTEST_SKIP() << "no machine code on this processor"

TEST(EquationVariant, IsRecordedOnceForASystem) {
  SKIP_WITHOUT_CODE();
  const std::shared_ptr<const CompiledSystem> system = servo("{}");
  const EquationVariant* codes[4] = {};
  std::vector<std::thread> threads;
  for (const EquationVariant*& code : codes)
    threads.emplace_back([&code, &system] { code = system->equation_variant(); });
  for (std::thread& thread : threads) thread.join();
  ASSERT_NE(codes[0], nullptr);
  for (const EquationVariant* code : codes) EXPECT_EQ(code, codes[0]);
  const CompiledFunction* functions[4] = {};
  threads.clear();
  for (const CompiledFunction*& function : functions)
    threads.emplace_back([&] {
      function = &codes[0]->function(EquationFunction::kResidual, {8, true, false});
    });
  for (std::thread& thread : threads) thread.join();
  for (const CompiledFunction* function : functions) EXPECT_EQ(function, functions[0]);
  const CompiledFunction* const residual = functions[0];
  ASSERT_NE(residual, nullptr);
  EXPECT_EQ(&codes[0]->function(EquationFunction::kResidual, {8, true, false}), residual)
      << "compiled once";
  EXPECT_NE(&codes[0]->function(EquationFunction::kResidual, {8, false, false}), residual);
}

TEST(EquationVariant, OnlyWhatDependsOnTheDesignComesWithIt) {
  SKIP_WITHOUT_CODE();
  const std::shared_ptr<const CompiledSystem> system = servo("{}");
  const EquationVariant& code = *system->equation_variant();
  std::size_t expressions = 0;
  for (int n : code.numbered(true).numbers) {
    const Recording::Node& node = code.numbered(true).recording.node(n);
    EXPECT_TRUE(!node.varies || (node.operation == Operation::kLeaf && node.a >= Recording::kTimed))
        << "node " << n;
    if (node.operation == Operation::kLeaf && node.a == Recording::kSupplied && node.b >= 0)
      ++expressions;
  }
  EXPECT_EQ(expressions, 5U) << "Kp, Ki, Kd, the weight, and the start as a terminal reference";
}

TEST(EquationVariant, KeepsTurnsAndFunctionsOfTimeThatAreUsed) {
  SKIP_WITHOUT_CODE();
  const auto study = [](const std::string& coordinates) {
    return motion_study(1.0, "{}", "elbow/velocity", "{coordinates: " + coordinates + "}");
  };
  const std::shared_ptr<const CompiledSystem> still = compile(double_pendulum(), study("absolute"));
  EXPECT_EQ(still->equation_variant()->numbered(false).turns.size(), 2U)
      << "of both hinges, whose references each step sets";
  EXPECT_TRUE(
      compile(double_pendulum(), study("joint"))->equation_variant()->numbered(false).turns.empty())
      << "coordinates count whole turns themselves";
  EXPECT_TRUE(still->equation_variant()->numbered(false).functions.empty())
      << "constants are no functions of time";
  const std::shared_ptr<const CompiledSystem> moved =
      compile(double_pendulum(),
              "duration: 1.0\nobjective: {integral: [{signal: elbow/velocity, reference: {type: "
              "sine, amplitude: 1.0, "
              "period: 2.0}}]}\n");
  ASSERT_EQ(moved->equation_variant()->numbered(false).functions.size(), 1U);
  const auto& orders = moved->equation_variant()->numbered(false).functions[0];
  EXPECT_GE(orders[0], 0);
  EXPECT_GE(orders[1], 0) << "G_t has the reference's rate";
}

TEST(EquationVariant, DecisionsByTheDesignAloneAreApart) {
  SKIP_WITHOUT_CODE();
  const std::string friction =
      "<codesign:friction mu_static='0.6' mu_dynamic='0.4' transition_velocity='0.1' "
      "joint_length='0.2' pin_radius='0.05' "
      "codesign:pin_radius='${radius}'/>";
  const std::shared_ptr<const CompiledSystem> system =
      compile(robot("<codesign:parameter name='radius' value='0.05'/>" + bar("arm") +
                    hinge("shoulder", "ground", "arm", "0 0 0", friction)),
              motion_study(1.0, "{}", "shoulder/velocity", "{}"));
  EXPECT_EQ(system->equation_variant()->design_guards().size(), 1U)
      << "whether the pin has a radius";
}

TEST(EquationVariant, EveryShippedCaseIsCompiled) {
  SKIP_WITHOUT_CODE();
  for (const char* name :
       {"slider_crank", "slider_crank_haug", "inverted_pendulum", "inverted_pendulum_frictionless",
        "governor", "two_link_arm", "arm_limits", "gantry"}) {
    const Shipped shipped(name);
    const std::shared_ptr<const CompiledSystem> system = make_system(shipped.robot, shipped.study);
    const EquationVariant* const code = system->equation_variant();
    ASSERT_NE(code, nullptr) << name;
    for (EquationFunction function : {EquationFunction::kResidual, EquationFunction::kLinearization,
                                      EquationFunction::kConstraintErrors})
      for (const EquationVariant::Scalar& scalar : {EquationVariant::Scalar{0, false, false},
                                                    {4, false, false},
                                                    {8, false, false},
                                                    {4, true, false},
                                                    {8, true, false}})
        EXPECT_EQ(code->function(function, scalar).interpreter, nullptr)
            << name << ", lanes " << scalar.lanes;
  }
}

}  // namespace
}  // namespace codesign
