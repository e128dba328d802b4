// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/description.h"

#include "reading/urdf/pictures.h"

namespace codesign {
namespace {

std::string trimmed(const std::string& text) {
  const char* const kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

bool has_the_values_of_its_model(const Problem& problem) {
  const std::vector<double> values = problem.parameters();
  for (std::size_t k = 0; k < problem.robot().parameters.size(); ++k)
    if (values[k] != problem.robot().parameters[k].value) return false;
  return true;
}

}  // namespace

bool describes(const std::string& text, const Problem& problem, const std::string& effective) {
  if (trimmed(text) == trimmed(effective) || trimmed(text) == trimmed(with_sticks(effective))) return true;
  return problem.overlays().empty() && has_the_values_of_its_model(problem) && trimmed(text) == trimmed(problem.urdf().text);
}

Warnings check_description(const ros::NodeHandle& node, const Problem& problem, const std::string& effective) {
  std::string text;
  if (!node.getParam("robot_description", text) || describes(text, problem, effective)) return {};
  const std::string name = node.resolveName("robot_description");
  return {warn("description_differs", {{name, 0},
                                       "robot_description",
                                       "the parameter describes another mechanism than the simulated one, so robot_state_publisher and "
                                       "rviz show the wrong one; the topic " +
                                           name + " has the URDF of the simulated one, and `codesign urdf` prints it",
                                       "",
                                       ""})};
}

}  // namespace codesign
