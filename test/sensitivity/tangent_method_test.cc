// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/tangent_method.h"

#include <gtest/gtest.h>

#include <complex>

#include "assembly/assembly.h"
#include "integration/servo.h"
#include "integration/tableaus.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
constexpr int kTangents = 4;
constexpr double kStepSize = 2e-3, kImaginary = 1e-30;

/// One step of the servo with the derivatives of its stages by `Method`, and
/// the same step with one parameter moved along the imaginary axis, which knows
/// nothing of them.
template <class Method>
void expect_derivatives_of_the_stages(const RosenbrockTableau& tableau) {
  const std::shared_ptr<const CompiledSystem> system = servo("{integrator: rosenbrock}");
  const std::vector<double> parameters = system->parameters();
  OneStep<double> step(*system, tableau);
  Assembly assembly(*system);
  State<double> initial;
  step.equations().set_design(parameters);
  ASSERT_TRUE(assembly.solve(parameters, &step.equations(), &initial).ok());
  step.start(initial);

  TangentMemory<kTangents> memory(*system, tableau);
  std::vector<Lanes<kTangents>> lanes(parameters.begin(), parameters.end());
  for (std::size_t k = 0; k < kTangents; ++k) lanes[k].v[static_cast<int>(k)] = 1.0;
  State<Lanes<kTangents>> start;
  memory.equations.equations().set_design(lanes);
  assembly.extend(lanes, initial, &memory.equations.equations(), &start);
  const auto take = [&memory](const VectorX<Lanes<kTangents>>& of, int first) {
    for (Eigen::Index k = 0; k < of.size(); ++k) memory.y.col(first + k) = of[k].directions();
  };
  take(start.q, memory.at.x());
  take(start.s, memory.at.s());
  take(start.v, memory.at.v());
  take(start.z, memory.at.z());
  Method method(&memory);
  method.begin(initial);
  ASSERT_TRUE(step.attempt(kStepSize));
  method.attempt(&step);

  for (std::size_t k = 0; k < kTangents; ++k) {
    std::vector<Complex> moved(parameters.begin(), parameters.end());
    moved[k] += Complex(0.0, kImaginary);
    OneStep<Complex> shifted(*system, tableau);
    shifted.equations().set_design(moved);
    State<Complex> shifted_start;
    assembly.extend(moved, initial, &shifted.equations(), &shifted_start);
    shifted.start(shifted_start);
    ASSERT_TRUE(shifted.attempt(kStepSize));
    for (std::size_t i = 0; i < memory.count(); ++i) {
      const Eigen::VectorXd expected = shifted.increments()[i].imag() / kImaginary,
                            actual = memory.stages[i].row(static_cast<Eigen::Index>(k)).transpose();
      EXPECT_LT((actual - expected).norm(), 1e-9 * (1.0 + expected.norm()))
          << "parameter " << k << ", stage " << i;
    }
  }
}

TEST(TangentMethod, DifferentiatesRosenbrockStages) {
  expect_derivatives_of_the_stages<RosenbrockTangent<kTangents>>(rodas4());
  expect_derivatives_of_the_stages<RosenbrockTangent<kTangents>>(rodas5p());
  expect_derivatives_of_the_stages<RosenbrockTangent<kTangents>>(rodas3());
}

TEST(TangentMethod, DifferentiatesExplicitStages) {
  expect_derivatives_of_the_stages<ExplicitTangent<kTangents>>(dopri5());
}

}  // namespace
}  // namespace codesign
