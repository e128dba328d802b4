// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/arrays.h"
#include "reading/study/study_blocks.h"
#include "reading/study/study_values.h"

namespace codesign {
namespace {

constexpr int kMostGridPositions = 10000;
constexpr std::size_t kMostInGrid = 1000000;
constexpr const char* kGridForms = "[position, ...] or {from, to, count}";

std::vector<double> read_grid_range(const YamlValue& value) {
  value.require_keys({"from", "to", "count"}, {});
  const double from = value.at("from").number(), to = value.at("to").number();
  const int count = value.at("count").integer();
  if (count < 2 || count > kMostGridPositions)
    value.at("count").fail("count out of range",
                           "a whole number from 2 to " + std::to_string(kMostGridPositions));
  std::vector<double> positions;
  for (int k = 0; k < count; ++k)
    positions.push_back(from + (to - from) * static_cast<double>(k) / (count - 1));
  return positions;
}

std::vector<double> read_grid_list(const YamlValue& value) {
  std::vector<double> positions;
  for (const YamlValue& item : value.items()) positions.push_back(item.number());
  if (positions.empty() || positions.size() > to_index(kMostGridPositions))
    value.fail("found " + std::to_string(positions.size()) + " positions",
               "1 to " + std::to_string(kMostGridPositions));
  return positions;
}

}  // namespace

PostureGrid read_posture_grid(const YamlValue& efforts, const RobotDescription& robot) {
  efforts.require_keys({"grid"}, {});
  const YamlValue value = efforts.at("grid");
  PostureGrid grid;
  for (const auto& [name, positions] : value.entries()) {
    const JointDescription& joint = scalar_joint(name, robot, positions);
    if (joint.is_loop)
      positions.fail("a loop has no position of its own in a grid", "joints of the URDF tree");
    grid.push_back({joint.name,
                    positions.is_map() ? read_grid_range(positions) : read_grid_list(positions),
                    positions.where()});
    if (count_postures(grid) > kMostInGrid)
      value.fail("more than a million postures", "fewer positions per joint");
  }
  if (grid.empty()) value.fail("no joint has a position", std::string("JOINT: ") + kGridForms);
  return grid;
}

}  // namespace codesign
