// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/peer_cases.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "mechanism_codesign/simulation.h"
#include "text/number_text.h"

namespace codesign {
namespace {

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

/// An attribute, and the same in times of a parameter.
std::string scaled(const std::string& name, double value, const std::string& parameter) {
  const std::string number = to_decimal(value);
  return " " + name + "=" + quoted(number) + " codesign:" + name + "=" +
         quoted("${" + number + "*" + parameter + "}");
}

std::string parameter_name(const PeerCase& of, std::size_t k) {
  return of.parameters[k].first + "_" +
         of.robot.links[static_cast<std::size_t>(of.parameters[k].second)].name;
}

/// The annotations of all parameters.
std::string overlay(const PeerCase& of) {
  std::string head = "<robot name=\"robot\" xmlns:codesign=\"urn:mechanism_codesign\">\n", text;
  for (std::size_t k = 0; k < of.parameters.size(); ++k) {
    const std::string name = parameter_name(of, k);
    const RobotLink& link = of.robot.links[static_cast<std::size_t>(of.parameters[k].second)];
    head +=
        "<codesign:parameter name=" + quoted(name) + " value=\"1\" lower=\"0.5\" upper=\"2\"/>\n";
    if (of.parameters[k].first == "mass") {
      const std::array<double, 3> I = inertia(link);
      text += "<link name=" + quoted(link.name) + "><inertial><mass" +
              scaled("value", link.mass, name) + "/><inertia" + scaled("ixx", I[0], name) +
              scaled("iyy", I[1], name) + scaled("izz", I[2], name) + "/></inertial></link>\n";
    } else {
      text += "<joint name=" + quoted(link.name + "_joint") + "><dynamics" +
              scaled("damping", link.damping, name) + "/></joint>\n";
    }
  }
  return head + text + "</robot>\n";
}

}  // namespace

std::vector<PeerCase> peer_cases() {
  const Robot arm = ur5(), humanoid = valkyrie();
  PeerCase all{"humanoid_gradient", humanoid, {}};
  for (const char* kind : {"mass", "damping"})
    for (std::size_t k = 0; k < humanoid.links.size(); ++k)
      all.parameters.emplace_back(kind, static_cast<int>(k));
  const std::vector<std::pair<std::string, int>> five = {
      {"mass", 1}, {"mass", 2}, {"damping", 0}, {"damping", 1}, {"damping", 2}};
  Robot recorded = arm;
  recorded.duration = 2.0;
  return {{"arm", arm, {}},
          {"humanoid", humanoid, {}},
          {"humanoid_dry", talos(), {}},
          {"arm_gradient", arm, five},
          {"arm_identify", recorded, five},
          all};
}

std::string sum_of_squares(const Robot& robot) {
  std::string terms;
  for (const RobotLink& link : robot.links)
    terms += (terms.empty() ? "{signal: " : ", {signal: ") + link.name + "_joint/position}";
  return "objective: {terminal: [" + terms + "]}\n";
}

Problem peer_problem(const PeerCase& of, const std::string& solver, const std::string& rest) {
  GeneratedCase files = robot_case(of.robot, solver);
  if (of.parameters.empty()) return load_problem(files.urdf, {}, files.study);
  std::string tuned;
  for (std::size_t k = 0; k < of.parameters.size(); ++k)
    tuned += (k == 0 ? "" : ", ") + parameter_name(of, k) + ": {}";
  files.study.text += "parameters: {" + tuned + "}\n" + rest;
  return load_problem(files.urdf, {{"parameters", overlay(of)}}, files.study);
}

std::vector<std::vector<double>> peer_recording(const PeerCase& of) {
  const GeneratedCase files =
      robot_case(of.robot,
                 "method: rodas5p, relative_tolerance: 1.0e-11, absolute_tolerance: 1.0e-12, "
                 "maximum_steps: 10000000");
  const Problem problem = load_problem(files.urdf, {}, files.study);
  Simulation simulation(problem, problem.parameters());
  std::vector<std::vector<double>> rows;
  const Status status = simulate(&simulation, of.robot.duration,
                                 static_cast<int>(std::lround(of.robot.duration * kPeerRate)) + 1,
                                 [&](const Frame& frame) {
                                   std::vector<double> row;
                                   for (const JointSample& joint : frame.joints)
                                     row.push_back(joint.position);
                                   for (const JointSample& joint : frame.joints)
                                     row.push_back(joint.velocity);
                                   rows.push_back(row);
                                   return true;
                                 });
  if (!status.ok()) throw std::runtime_error(status.cause);
  return rows;
}

Robot with_parameter(const PeerCase& of, std::size_t parameter, double value) {
  Robot robot = of.robot;
  RobotLink& link = robot.links[static_cast<std::size_t>(of.parameters[parameter].second)];
  (of.parameters[parameter].first == "mass" ? link.mass : link.damping) *= value;
  return robot;
}

void write_peer_case(const PeerCase& of, const std::string& folder) {
  nlohmann::json about = {{"duration", of.robot.duration}};
  for (const RobotLink& link : of.robot.links) {
    about["joints"].push_back(link.name + "_joint");
    about["start"].push_back(link.position);
  }
  about["parameters"] = nlohmann::json::array();
  for (const auto& [kind, link] : of.parameters)
    about["parameters"].push_back({kind, of.robot.links[static_cast<std::size_t>(link)].name});
  if (of.name == "arm_identify") about["recording"] = peer_recording(of);
  const std::string path = folder + "/" + of.name;
  std::ofstream urdf(path + ".urdf"), json(path + ".json");
  urdf << robot_case(of.robot, "").urdf.text << std::flush;
  json << about.dump(1) << "\n" << std::flush;
  if (!urdf || !json) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace codesign
