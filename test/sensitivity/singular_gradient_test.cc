// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients of motions through singular positions are right to four digits, or come with a warning,
// or fail.
#include <gtest/gtest.h>

#include <algorithm>

#include "integration/linkages.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// IFToMM's A02 past its flat position, by the speed it starts with.
Evaluation evaluate(const std::string& integrator, double tolerance, double duration) {
  std::string urdf = upright_row(2);
  urdf.insert(urdf.find('>') + 1,
              "<codesign:parameter name='rate' value='1' lower='0.5' upper='2'/>");
  const std::string study = "duration: " + to_decimal(duration) +
                            "\nparameters: {rate: {}}\ninitial_state: {hinge0: {position: 0.0, "
                            "velocity: '${rate}'}}\nsolver: {integrator: " +
                            integrator + ", relative_tolerance: " + to_decimal(tolerance) +
                            ", absolute_tolerance: " + to_decimal(tolerance) +
                            "}\nobjective: {integral: [{signal: hinge0/velocity}]}\n";
  const Problem problem = load_problem({"row.urdf", urdf}, {}, {"row.yaml", study});
  return Evaluator(problem).evaluate(problem.start(), true);
}

TEST(SingularGradient, ADoubleParallelogramWarnsOrFailsOrIsRightByBothIntegrators) {
  for (const char* integrator : {"rosenbrock", "idas"}) {
    for (double tolerance : {1e-5, 1e-6, 1e-7}) {
      for (double duration : {3.0, 3.5}) {
        const Evaluation e = evaluate(integrator, tolerance, duration);
        const bool warned = std::any_of(e.warnings.begin(), e.warnings.end(), [](const Warning& w) {
          return w.code == "singular_position_passed" || w.code == "sensitivities_restarted";
        });
        if (!e.status.ok() || warned) continue;
        // Steps that are short enough for the sensitivities may leave nothing to warn of.
        const double right = duration > 3.2 ? 7.134 : 41.958;
        EXPECT_NEAR(e.gradient[0], right, 1e-4 * right)
            << integrator << " at " << tolerance << " over " << duration << " s";
      }
    }
  }
}

}  // namespace
}  // namespace codesign
