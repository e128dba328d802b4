// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/servo_steps.h"

namespace codesign {

ServoSteps::ServoSteps(const RosenbrockTableau& of_method)
    : tableau(of_method),
      step(*system, tableau),
      tangent(*system, tableau),
      adjoint(*system, tableau),
      assembly(*system) {
  step.equations().set_design(parameters);
  EXPECT_TRUE(assembly.solve(parameters, &step.equations(), &initial).ok());
  step.start(initial);
  std::vector<Lanes<8>> lanes(parameters.begin(), parameters.end());
  for (std::size_t k = 0; k < lanes.size(); ++k) lanes[k].v[static_cast<int>(k)] = 1.0;
  tangent.start(lanes, assembly, initial);
  begin = tangent.directions();
  points.push_back(initial);
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(step.attempt(kSize));
    tangent.attempt(&step);
    EXPECT_TRUE(step.accept());
    tangent.accept(step);
    points.push_back(step.unprojected());
  }
  end = tangent.directions();
}

ServoSteps::~ServoSteps() = default;

}  // namespace codesign
