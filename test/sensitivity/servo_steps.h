// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "assembly/assembly.h"
#include "integration/servo.h"
#include "sensitivity/adjoint_step.h"
#include "sensitivity/lane_directions.h"
#include "sensitivity/tangent_step.h"

namespace codesign {

/// Three steps of the servo with the tangent by its five parameters, the points between the steps,
/// and the backward pass.
struct ServoSteps {
  static constexpr double kSize = 2e-3;

  explicit ServoSteps(const RosenbrockTableau& of_method);
  ~ServoSteps();

  /// The adjoint at the start for a given adjoint at the end. @param visit called with each point's
  /// index after its step has been reversed.
  template <class Visit>
  const VectorX<double>& back(const VectorX<double>& last, const Visit& visit) {
    adjoint.start(parameters, last);
    for (std::size_t k = points.size(); k-- > 0;) {
      adjoint.clear();
      if (k == 0) {
        step.start(points[k]);
      } else {
        EXPECT_TRUE(step.resume(points[k]));
      }
      if (k + 1 < points.size()) {
        EXPECT_TRUE(step.attempt(kSize));
        adjoint.reverse_stages(&step);
      }
      if (k > 0) adjoint.reverse_projection(points[k], step);
      adjoint.reverse_matrices(points[k]);
      visit(k);
    }
    return adjoint.adjoint();
  }

  const std::shared_ptr<const CompiledSystem> system = servo("{}");
  const std::vector<double> parameters = system->parameters();
  const RosenbrockTableau& tableau;
  OneStep<double> step;
  TangentStep<8> tangent;
  AdjointStep adjoint;
  Assembly assembly;
  State<double> initial;
  std::vector<State<double>> points;
  Directions<8> begin, end;  ///< y_rho
};

}  // namespace codesign
