// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cases/shipped.h"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace codesign {

Shipped::Shipped(const std::string& name, const std::string& overlay) {
  const std::string root = source_dir();
  std::vector<SourceText> overlays;
  const std::string own = root + "/urdf/overlays/" + name + ".urdf";
  if (!overlay.empty())
    overlays.push_back(read_source(root + "/urdf/overlays/" + overlay + ".urdf"));
  else if (std::filesystem::exists(own))
    overlays.push_back(read_source(own));
  robot = read_urdf(read_source(root + "/urdf/" + name + ".urdf"), overlays);
  study = read_study(read_source(root + "/config/" + name + ".yaml"), robot);
}

Shipped::~Shipped() = default;
Shipped::Shipped(const Shipped&) = default;

std::vector<double> Shipped::parameters() const {
  std::vector<double> values;
  for (const Parameter& parameter : study.parameters) values.push_back(parameter.value);
  return values;
}

Eigen::VectorXd Shipped::start() const {
  Eigen::VectorXd rho(static_cast<Eigen::Index>(study.tuned.size()));
  for (std::size_t k = 0; k < study.tuned.size(); ++k)
    rho[static_cast<Eigen::Index>(k)] =
        study.parameters[static_cast<std::size_t>(study.tuned[k])].value;
  return rho;
}

Problem shipped_problem(const std::string& name,
                        const std::vector<std::pair<std::string, std::string>>& changes,
                        const ParameterSettings& settings) {
  const std::string root = source_dir();
  SourceText study = read_source(root + "/config/" + name + ".yaml");
  for (const auto& [from, to] : changes) {
    const std::size_t at = study.text.find(from);
    if (at == std::string::npos)
      ADD_FAILURE() << study.name << " does not have " << from;
    else
      study.text.replace(at, from.size(), to);
  }
  return load_problem(read_source(root + "/urdf/" + name + ".urdf"), {}, study, settings);
}

void expect_counts(const Shipped& shipped, const std::vector<int>& table) {
  Status status;
  const Counts c =
      count_equations(*make_system(shipped.robot, shipped.study), shipped.parameters(), &status);
  ASSERT_TRUE(status.ok()) << status.cause;
  EXPECT_EQ(
      (std::vector<int>{c.coordinates, c.first_order_equations, c.degrees_of_freedom, c.constraints,
                        c.dynamic_equations, c.parameters, c.sensitivities, c.total_equations}),
      table);
  EXPECT_EQ(c.redundant_constraints, 0);
}

void expect_reference(const Shipped& shipped, double objective, double tolerance,
                      const std::vector<double>& gradient, double gradient_tolerance) {
  const Evaluation evaluation =
      evaluator_of(make_system(shipped.robot, shipped.study)).evaluate(shipped.start(), true);
  ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
  EXPECT_NEAR(evaluation.objective / objective, 1.0, tolerance);
  ASSERT_EQ(static_cast<std::size_t>(evaluation.gradient.size()), gradient.size());
  for (std::size_t k = 0; k < gradient.size(); ++k)
    EXPECT_NEAR(evaluation.gradient[static_cast<Eigen::Index>(k)] / gradient[k], 1.0,
                gradient_tolerance)
        << k;
}

void expect_series(const Shipped& shipped, const std::vector<SignalPoints>& expected) {
  std::vector<SignalDescription> signals;
  for (const SignalPoints& points : expected)
    signals.push_back(parse_signal(points.signal, {"test", 0}, "signal"));
  Simulation simulation =
      simulation_of(make_system(shipped.robot, shipped.study), shipped.parameters(), signals);
  std::size_t at = 0;
  const Status status = simulate(&simulation, shipped.study.duration, 5, [&](const Frame& frame) {
    for (std::size_t k = 0; at > 0 && k < expected.size(); ++k)
      EXPECT_NEAR(frame.signals[k], expected[k].values.at(at - 1), 1e-5 * expected[k].range)
          << expected[k].signal << " at " << frame.time;
    ++at;
    return true;
  });
  EXPECT_TRUE(status.ok()) << status.cause;
  EXPECT_EQ(at, 5U);
}

}  // namespace codesign
