// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Pinocchio's articulated-body algorithm and its derivatives, from C++, with an integrator that its
// users would take: the pair of Dormand and Prince of this folder's robots, or CVODE with the exact
// Jacobian. race.py compiles it against the package of PyPI; it answers like the benchmark program.
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <time.h>

#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/config.hpp>
#include <pinocchio/parsers/urdf.hpp>
#include <sstream>

#include "benchmark/dormand_prince.h"

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSteepness = 400.0;  // of dry friction: tanh(4 v / 0.01)

double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Joints without limits as revolute ones, so that positions are angles.
std::string with_angles(std::string text) {
  const std::string from = "type=\"continuous\">",
                    to = "type=\"revolute\"><limit lower=\"-1e6\" upper=\"1e6\" effort=\"1e6\" "
                         "velocity=\"1e6\"/>";
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

double attribute(const std::string& text, std::size_t from, const std::string& name) {
  const std::size_t at = text.find(name + "=\"", from) + name.size() + 2;
  return std::stod(text.substr(at));
}

/// A case with its mechanism.
struct Robot {
  explicit Robot(const std::string& path) : about(nlohmann::json::parse(text_of(path + ".json"))) {
    const std::string text = with_angles(text_of(path + ".urdf"));
    pinocchio::urdf::buildModelFromXML(text, model);
    data = pinocchio::Data(model);
    n = model.nv;
    damping.setZero(n);
    friction.setZero(n);
    start.setZero(n);
    for (std::size_t k = 0; k < about["joints"].size(); ++k) {
      const std::string name = about["joints"][k];
      const auto joint = model.getJointId(name);
      const Eigen::Index place = model.joints[joint].idx_v();
      places.push_back(place);
      start[place] = about["start"][k];
      const std::size_t element = text.find("<joint name=\"" + name + "\"");
      damping[place] = attribute(text, element, "damping");
      friction[place] = attribute(text, element, "friction");
    }
    for (const auto& parameter : about["parameters"]) {
      const auto joint = model.getJointId(parameter[1].get<std::string>() + "_joint");
      parameters.emplace_back(parameter[0] == "mass", joint);
    }
  }

  const VectorXd& effort(const VectorXd& v) {
    tau = -damping.array() * v.array() - friction.array() * (kSteepness * v.array()).tanh();
    return tau;
  }
  /// Derivatives of the efforts by the rates.
  VectorXd slope(const VectorXd& v) const {
    const Eigen::ArrayXd c = (kSteepness * v.array()).cosh();
    return -damping.array() - friction.array() * kSteepness / (c * c);
  }
  void rates(const VectorXd& y, VectorXd* rate) {
    q = y.head(n);
    v = y.segment(n, n);
    rate->head(n) = v;
    rate->segment(n, n) = pinocchio::aba(model, data, q, v, effort(v));
  }
  /// The accelerations' derivatives by positions and rates, efforts included.
  void derivatives(const VectorXd& y) {
    q = y.head(n);
    v = y.segment(n, n);
    pinocchio::computeABADerivatives(model, data, q, v, effort(v));
    inverse = data.Minv.selfadjointView<Eigen::Upper>();
    by_rate = data.ddq_dv;
    by_rate.noalias() += inverse * slope(v).asDiagonal();
  }
  /// Rates of (q, v, S), S the derivatives of (q, v) by the parameters, one column each.
  void rates_with_sensitivities(const VectorXd& y, VectorXd* rate) {
    derivatives(y);
    rate->head(n) = v;
    acceleration = data.ddq;
    rate->segment(n, n) = acceleration;
    pinocchio::computeJointTorqueRegressor(model, data, q, v, acceleration);
    const auto p = static_cast<Eigen::Index>(parameters.size());
    push.setZero(n, p);
    for (Eigen::Index k = 0; k < p; ++k) {
      const auto [is_mass, joint] = parameters[static_cast<std::size_t>(k)];
      const Eigen::Index place = model.joints[joint].idx_v();
      if (is_mass)
        push.col(k) =
            -data.jointTorqueRegressor.middleCols(10 * (static_cast<Eigen::Index>(joint) - 1), 10) *
            model.inertias[joint].toDynamicParameters();
      else
        push(place, k) = -damping[place] * v[place];
    }
    const Eigen::Map<const MatrixXd> S(y.data() + 2 * n, 2 * n, p);
    Eigen::Map<MatrixXd> S_rate(rate->data() + 2 * n, 2 * n, p);
    S_rate.topRows(n) = S.bottomRows(n);
    S_rate.bottomRows(n).noalias() = data.ddq_dq * S.topRows(n);
    S_rate.bottomRows(n).noalias() += by_rate * S.bottomRows(n);
    S_rate.bottomRows(n).noalias() += inverse * push;
  }

  nlohmann::json about;
  pinocchio::Model model;
  pinocchio::Data data;
  Eigen::Index n = 0;
  VectorXd damping, friction, start, q, v, tau, acceleration;
  MatrixXd inverse, by_rate, push;
  std::vector<Eigen::Index> places;
  std::vector<std::pair<bool, pinocchio::JointIndex>> parameters;  ///< a mass, or a damping
};

struct Answer {
  long steps;
  std::vector<double> values;
};

std::vector<double> positions(const Robot& robot, const double* y) {
  std::vector<double> all;
  for (const Eigen::Index place : robot.places) all.push_back(y[place]);
  return all;
}

Answer run_pair(Robot* robot, double tolerance) {
  const auto p = static_cast<Eigen::Index>(robot->parameters.size());
  const Eigen::Index n = robot->n;
  VectorXd y = VectorXd::Zero(2 * n * (1 + p));
  y.head(n) = robot->start;
  const std::function<void(const VectorXd&, VectorXd*)> rates = [robot, p](const VectorXd& state,
                                                                           VectorXd* rate) {
    if (p == 0)
      robot->rates(state, rate);
    else
      robot->rates_with_sensitivities(state, rate);
  };
  codesign::DormandPrince<decltype(rates)> pair(rates, y, tolerance);
  pair.advance_to(robot->about["duration"]);
  if (p == 0) return {pair.steps(), positions(*robot, pair.state().data())};
  const Eigen::Map<const MatrixXd> S(pair.state().data() + 2 * n, 2 * n, p);
  const VectorXd gradient = 2.0 * S.topRows(n).transpose() * pair.state().head(n);
  return {pair.steps(), {gradient.data(), gradient.data() + p}};
}

int cvode_rates(sunrealtype, N_Vector y, N_Vector rate, void* user) {
  auto* robot = static_cast<Robot*>(user);
  const VectorXd state = Eigen::Map<const VectorXd>(NV_DATA_S(y), 2 * robot->n);
  VectorXd out(2 * robot->n);
  robot->rates(state, &out);
  std::copy(out.data(), out.data() + out.size(), NV_DATA_S(rate));
  return 0;
}

int cvode_jacobian(sunrealtype, N_Vector y, N_Vector, SUNMatrix J, void* user, N_Vector, N_Vector,
                   N_Vector) {
  auto* robot = static_cast<Robot*>(user);
  const Eigen::Index n = robot->n;
  robot->derivatives(Eigen::Map<const VectorXd>(NV_DATA_S(y), 2 * n));
  Eigen::Map<MatrixXd> all(SUNDenseMatrix_Data(J), 2 * n, 2 * n);
  all.topLeftCorner(n, n).setZero();
  all.topRightCorner(n, n).setIdentity();
  all.bottomLeftCorner(n, n) = robot->data.ddq_dq;
  all.bottomRightCorner(n, n) = robot->by_rate;
  return 0;
}

Answer run_cvode(Robot* robot, double tolerance) {
  static SUNContext context = [] {
    SUNContext made;
    SUNContext_Create(nullptr, &made);
    return made;
  }();
  const Eigen::Index size = 2 * robot->n;
  N_Vector y = N_VNew_Serial(size, context);
  std::fill(NV_DATA_S(y), NV_DATA_S(y) + size, 0.0);
  std::copy(robot->start.data(), robot->start.data() + robot->n, NV_DATA_S(y));
  void* cvode = CVodeCreate(CV_BDF, context);
  CVodeInit(cvode, cvode_rates, 0.0, y);
  CVodeSStolerances(cvode, tolerance, 0.1 * tolerance);
  CVodeSetUserData(cvode, robot);
  CVodeSetMaxNumSteps(cvode, 10000000);
  SUNMatrix matrix = SUNDenseMatrix(size, size, context);
  SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
  CVodeSetLinearSolver(cvode, solver, matrix);
  CVodeSetJacFn(cvode, cvode_jacobian);
  const double end = robot->about["duration"];
  CVodeSetStopTime(cvode, end);
  double t = 0.0;
  const int flag = CVode(cvode, end, y, &t, CV_NORMAL);
  long steps = 0;
  CVodeGetNumSteps(cvode, &steps);
  const Answer answer{steps, positions(*robot, NV_DATA_S(y))};
  CVodeFree(&cvode);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  N_VDestroy(y);
  if (flag < 0) throw std::runtime_error("CVODE failed");
  return answer;
}

/// Calls of the algorithm alone, so many that they can be timed.
Answer run_calls(Robot* robot) {
  VectorXd y = VectorXd::Zero(2 * robot->n), rate(2 * robot->n);
  y.head(robot->n) = robot->start;
  constexpr long kCalls = 1000;
  for (long k = 0; k < kCalls; ++k) robot->rates(y, &rate);
  return {kCalls, {}};
}

Answer run(Robot* robot, const std::string& method, double tolerance) {
  if (method == "aba()") return run_calls(robot);
  return method == "CVODE BDF" ? run_cvode(robot, tolerance) : run_pair(robot, tolerance);
}

std::string answer_to(const std::string& folder, const std::string& line) {
  static std::map<std::string, Robot> robots;
  std::istringstream in(line);
  std::string name, method, tolerance;
  std::getline(in, name, '\t');
  std::getline(in, method, '\t');
  std::getline(in, tolerance);
  Robot* const robot = &robots.try_emplace(name, folder + "/" + name).first->second;
  Answer answer = run(robot, method, std::stod(tolerance));
  double least = std::numeric_limits<double>::infinity(), spent = 0.0;
  while (spent < 0.05) {
    const double begin = processor_seconds();
    answer = run(robot, method, std::stod(tolerance));
    const double seconds = processor_seconds() - begin;
    least = std::min(least, seconds);
    spent += seconds;
  }
  std::ostringstream out;
  out.precision(17);
  out << "ok " << answer.steps << " " << least;
  for (const double value : answer.values) out << " " << value;
  return out.str();
}

}  // namespace

int main(int, char** argv) {
  std::cout << "ready " << PINOCCHIO_VERSION << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
    try {
      std::cout << answer_to(argv[1], line) << std::endl;
    } catch (const std::exception& error) {
      std::cout << "no " << error.what() << std::endl;
    }
  }
}
