// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/guess_text.h"

#include <algorithm>
#include <cmath>

#include "description/motion_study.h"
#include "description/robot.h"
#include "math/arrays.h"
#include "system/tree_kinematics.h"
#include "text/number_text.h"

namespace codesign {
namespace {

double to_four_digits(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

}  // namespace

std::string guess_text(const RobotDescription& robot, const TreeLayout& tree,
                       const VectorX<double>& theta, const std::vector<int>& coordinates) {
  std::string text;
  for (const int j : tree.joint_order) {
    const JointDescription& joint = robot.joints[to_index(j)];
    const int c = tree.offset[to_index(j)];
    if (joint.has_one_coordinate() &&
        std::find(coordinates.begin(), coordinates.end(), c) != coordinates.end())
      text += (text.empty() ? "" : ", ") + joint.name +
              ": {guess: " + to_decimal(to_four_digits(theta[c])) + "}";
  }
  return text;
}

std::string design_text(const MotionStudy& study, const std::vector<double>& parameters) {
  constexpr std::size_t kMost = 12;
  std::string text;
  for (std::size_t k = 0; k < std::min(kMost, study.tuned.size()); ++k) {
    const auto index = to_index(study.tuned[k]);
    text +=
        (k > 0 ? ", " : "") + study.parameters[index].name + " = " + readable(parameters[index], 6);
  }
  return text + (study.tuned.size() > kMost ? ", ..." : "");
}

}  // namespace codesign
