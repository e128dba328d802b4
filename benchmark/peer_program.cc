// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// This package, SUNDIALS and Simbody, as one of the programs of benchmark/peers, whose race.py
// starts it. Usage: peer_program FOLDER. It writes the models of the comparison as plain URDF and
// JSON into FOLDER, then answers requests from the standard input, one per line: case, method and
// tolerance with tabs between. An answer is "ok STEPS SECONDS VALUES...", with the least processor
// time of a few runs [s], or "no REASON". Values are the joint positions at the end, or the
// gradient.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "benchmark/peer_cases.h"
#include "benchmark/peer_identification.h"
#include "benchmark/robot_peers.h"
#include "benchmark/slider_crank.h"
#include "benchmark/sundials_peer.h"
#include "equations/compiled_system.h"
#include "math/cpu_timer.h"
#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/simulation.h"
#include "text/number_text.h"

namespace codesign {
namespace {

void require(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.cause);
}

std::vector<double> list(const Eigen::VectorXd& x) { return {x.data(), x.data() + x.size()}; }

/// The last instant of a motion.
PeerAnswer end_of(const Robot& robot, const RobotMotion& motion) {
  const auto joints = static_cast<std::ptrdiff_t>(robot.links.size());
  return {motion.steps, {motion.positions.end() - joints, motion.positions.end()}};
}

/// Entries of `solver` with a tolerance; direct sensitivities have it, too. The adjoint has none.
std::string solver(const std::string& method, double tolerance) {
  const std::string relative = to_decimal(tolerance);
  const std::size_t colon = method.find(':');
  const std::string gradient = colon == std::string::npos ? "" : method.substr(colon + 1);
  return "coordinates: joint, method: " + method.substr(0, colon) +
         ", relative_tolerance: " + relative +
         ", absolute_tolerance: " + to_decimal(0.1 * tolerance) + ", maximum_steps: 10000000" +
         (gradient == "direct" ? ", sensitivity_tolerance: " + relative : "") +
         (gradient.empty() ? "" : ", gradient: " + gradient);
}

PeerRun own_motion(const PeerCase& of, const std::string& method, double tolerance) {
  const auto problem = std::make_shared<Problem>(peer_problem(of, solver(method, tolerance), ""));
  const auto simulation = std::make_shared<Simulation>(*problem, problem->parameters());
  const double duration = of.robot.duration;
  return [problem, simulation, duration] {
    Frame frame;
    require(simulation->start());
    require(simulation->advance_to(duration));
    simulation->sample(duration, &frame);
    PeerAnswer answer{static_cast<long>(simulation->statistics().steps), {}};
    for (const JointSample& joint : frame.joints) answer.values.push_back(joint.position);
    return answer;
  };
}

PeerRun gradient_run(const Problem& problem) {
  const auto evaluator = std::make_shared<Evaluator>(problem);
  const Eigen::VectorXd rho = problem.start();
  return [evaluator, rho] {
    const Evaluation evaluation = evaluator->evaluate(rho, true);
    require(evaluation.status);
    return PeerAnswer{static_cast<long>(evaluation.statistics.steps), list(evaluation.gradient)};
  };
}

double squares(const PeerAnswer& answer) {
  double sum = 0.0;
  for (const double x : answer.values) sum += x * x;
  return sum;
}

/// Central differences, with the step that balances their error against the integration's.
PeerRun differences(const PeerCase& of, double accuracy) {
  return [of, accuracy] {
    const double h = 0.5 * std::cbrt(accuracy);
    PeerAnswer answer;
    for (std::size_t k = 0; k < of.parameters.size(); ++k) {
      double difference = 0.0;
      for (const double sign : {1.0, -1.0}) {
        const Robot moved = with_parameter(of, k, 1.0 + sign * h);
        const PeerAnswer run = end_of(moved, *run_simbody_robot(moved, accuracy));
        difference += sign * squares(run);
        answer.steps += run.steps;
      }
      answer.values.push_back(difference / (2.0 * h));
    }
    return answer;
  };
}

/// The shipped slider-crank: psi, and its gradient if the case is the second one.
PeerRun slider_crank_run(const std::string& method, double tolerance, bool with_gradient) {
  const Problem problem = load_slider_crank();
  if (method == "SUNDIALS, KLU" || method == "SUNDIALS, dense") {
    const auto kind = method == "SUNDIALS, KLU" ? SundialsMatrix::kSparseExact
                                                : SundialsMatrix::kDenseDifferences;
    const auto peer = std::make_shared<SundialsPeer>(
        system_of(*with_solver(problem, "rodas5p", tolerance)), kind);
    return [peer, tolerance, with_gradient] {
      const SundialsResult result = peer->run(tolerance, with_gradient);
      if (!result.ok) throw std::runtime_error("SUNDIALS failed");
      return PeerAnswer{result.steps,
                        with_gradient ? list(result.gradient) : std::vector<double>{result.psi}};
    };
  }
  const Problem chosen = *with_solver(problem, method, tolerance);
  if (with_gradient) return gradient_run(chosen);
  const auto evaluator = std::make_shared<Evaluator>(chosen);
  const Eigen::VectorXd rho = chosen.start();
  return [evaluator, rho] {
    const Evaluation evaluation = evaluator->evaluate(rho, false);
    require(evaluation.status);
    return PeerAnswer{static_cast<long>(evaluation.statistics.steps), {evaluation.objective}};
  };
}

PeerRun prepare(const std::vector<PeerCase>& cases, const std::string& name,
                const std::string& method, double tolerance) {
  if (name == "slider_crank" || name == "slider_crank_gradient")
    return slider_crank_run(method, tolerance, name != "slider_crank");
  const auto of = std::find_if(cases.begin(), cases.end(),
                               [&](const PeerCase& each) { return each.name == name; });
  if (of == cases.end()) throw std::runtime_error("no case '" + name + "'");
  if (name == "arm_identify") return identification(*of, solver("rodas5p", tolerance));
  if (method != "Simbody" && of->parameters.empty()) return own_motion(*of, method, tolerance);
  if (method != "Simbody")
    return gradient_run(peer_problem(*of, solver(method, tolerance), sum_of_squares(of->robot)));
  if (!run_simbody_robot(of->robot, 1e-3))
    throw std::runtime_error("this program has no Simbody, or not for stiff motions");
  if (!of->parameters.empty()) return differences(*of, tolerance);
  const Robot robot = of->robot;
  return [robot, tolerance] { return end_of(robot, *run_simbody_robot(robot, tolerance)); };
}

/// The answer to a request: one run that warms up, if it is not long, then runs for at least
/// `kShortest` [s].
std::string answer_to(const std::vector<PeerCase>& cases, const std::string& line) {
  constexpr double kShortest = 0.03, kLong = 1.0;
  std::istringstream in(line);
  std::string name, method, tolerance;
  std::getline(in, name, '\t');
  std::getline(in, method, '\t');
  std::getline(in, tolerance);
  const PeerRun run = prepare(cases, name, method, std::stod(tolerance));
  double least = std::numeric_limits<double>::infinity(), spent = 0.0;
  const CpuTimer first;
  PeerAnswer answer = run();
  if (first.seconds() > kLong) spent = least = first.seconds();
  while (spent < kShortest) {
    const CpuTimer timer;
    answer = run();
    least = std::min(least, timer.seconds());
    spent += timer.seconds();
  }
  std::string text = "ok " + std::to_string(answer.steps) + " " + to_decimal(least);
  for (const double value : answer.values) text += " " + to_decimal(value);
  return text;
}

int serve(const std::string& folder) {
  const std::vector<PeerCase> cases = peer_cases();
  for (const PeerCase& each : cases) write_peer_case(each, folder);
  std::cout << "ready" << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
    try {
      std::cout << answer_to(cases, line) << std::endl;
    } catch (const std::exception& error) {
      std::cout << "no " << error.what() << std::endl;
    }
  }
  return 0;
}

}  // namespace
}  // namespace codesign

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: peer_program FOLDER, where urdf/ and config/ are\n";
    return 2;
  }
  try {
    return codesign::serve(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "peer_program: " << error.what() << "\n";
    return 1;
  }
}
