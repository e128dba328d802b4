// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/jobs/request.h"

#include <gtest/gtest.h>

#include <functional>

#include "description/study.h"
#include "jobs/files.h"
#include "jobs/job_files.h"
#include "mechanism_codesign/error.h"
#include "problem/load_problem.h"
#include "ros/bags/bag_contents.h"
#include "ros/pendulum.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

using mechanism_codesign::EvaluateRequest;
using mechanism_codesign::OptimizeGoal;
using Names = std::vector<std::string>;

/// The error message of a request, beginning with the field; the test fails if the request is
/// valid.
std::string fault_of(const std::function<void()>& use) {
  try {
    use();
  } catch (const InputError& error) {
    return error.fault().element + ": " + error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

std::string fault_of(const OptimizeGoal& request) {
  return fault_of([&] { apply_request(pendulum(), request); });
}

std::string fault_of(const EvaluateRequest& request) {
  return fault_of([&] { design_of(pendulum(), request); });
}

TEST(OptimizeRequest, AnEmptyOneChangesNothing) {
  const Problem problem = pendulum();
  const OptimizationRequest same = apply_request(problem, OptimizeGoal());
  EXPECT_EQ(system_of(same.problem), system_of(problem));
  EXPECT_EQ(same.problem.start(), problem.start());
  EXPECT_EQ(same.options.algorithm, "lbfgs");
  EXPECT_EQ(same.options.max_evaluations, 30);
  EXPECT_EQ(same.options.relative_tolerance, study_of(problem).optimizer.relative_tolerance);
}

TEST(OptimizeRequest, ChoosesParametersAndStarts) {
  OptimizeGoal request;
  request.parameters = {"mass", "length"};
  request.start = {1.5, 0.25 + 0.125};
  const Problem changed = apply_request(pendulum(), request).problem;
  EXPECT_EQ(changed.tuned_names(), (Names{"mass", "length"}));
  EXPECT_EQ(changed.start(), Eigen::Vector2d(1.5, 0.375));
}

TEST(OptimizeRequest, StartsAloneAreThoseOfTheStudysParameters) {
  OptimizeGoal request;
  request.start = {0.375, 2.0};
  const Problem changed = apply_request(pendulum(), request).problem;
  EXPECT_EQ(changed.tuned_names(), (Names{"length", "Kp"}));
  EXPECT_EQ(changed.start(), Eigen::Vector2d(0.375, 2.0));
}

TEST(OptimizeRequest, ChoosesOptions) {
  OptimizeGoal request;
  request.algorithm = "mma";
  request.max_evaluations = 7;
  request.relative_tolerance = 1e-3;
  const OptimizerOptions options = apply_request(pendulum(), request).options;
  EXPECT_EQ(options.algorithm, "mma");
  EXPECT_EQ(options.max_evaluations, 7);
  EXPECT_EQ(options.relative_tolerance, 1e-3);
}

TEST(OptimizeRequest, ATradeOffIsNotTheNodes) {
  std::string study = kPendulumStudy;
  const std::size_t first = study.find("objective:");
  study = study.substr(0, first) +
          "tradeoff:\n  - {name: slow, objective: {integral: [{signal: hinge/velocity}]}}\n"
          "  - {name: near, objective: {integral: [{signal: hinge/position}]}}\n";
  const Problem problem = load_problem({"pendulum.urdf", kPendulumUrdf}, {}, {"study", study});
  EXPECT_NE(fault_of([&] { apply_request(problem, OptimizeGoal()); }).find("codesign tradeoff"),
            std::string::npos);
}

TEST(OptimizeRequest, FaultsNameTheField) {
  OptimizeGoal request;
  request.parameters = {"lenght"};
  EXPECT_NE(fault_of(request).find("length"), std::string::npos) << "the nearest name";
  request.parameters = {"length", "length"};
  EXPECT_EQ(fault_of(request).find("parameters: "), 0U);
  request.parameters = {"length"};
  request.start = {0.5, 1.0};
  EXPECT_EQ(fault_of(request).find("start: "), 0U);
  request.start = {0.9};
  EXPECT_NE(fault_of(request).find("[0.3, 0.8]"), std::string::npos);
  request.start = {std::nan("")};
  EXPECT_NE(fault_of(request).find("[0.3, 0.8]"), std::string::npos);
  request = OptimizeGoal();
  request.max_evaluations = 4000000000U;
  EXPECT_EQ(fault_of(request).find("max_evaluations: "), 0U);
  request = OptimizeGoal();
  request.relative_tolerance = -1.0;
  EXPECT_EQ(fault_of(request).find("relative_tolerance: "), 0U);
}

TEST(EvaluateRequest, TheOthersStayAtTheirStart) {
  EvaluateRequest request;
  EXPECT_EQ(design_of(pendulum(), request), Eigen::Vector2d(0.5, 1.0));
  request.parameters = {"Kp"};
  request.values = {2.0};
  EXPECT_EQ(design_of(pendulum(), request), Eigen::Vector2d(0.5, 2.0));
}

TEST(EvaluateRequest, FaultsNameTheField) {
  EvaluateRequest request;
  request.parameters = {"mass"};
  request.values = {1.0};
  EXPECT_EQ(fault_of(request).find("parameters: "), 0U) << "not among the tuned";
  request.parameters = {"Kp"};
  request.values = {};
  EXPECT_EQ(fault_of(request).find("values: "), 0U);
  request.values = {5.5};
  EXPECT_NE(fault_of(request).find("[0, 5]"), std::string::npos);
}

TEST(ARequest, OfMoreNamesThanThereAreParametersIsRefusedAtOnce) {
  OptimizeGoal goal;
  EvaluateRequest evaluation;
  for (int k = 0; k < 200000; ++k) goal.parameters.push_back("parameter_" + std::to_string(k));
  evaluation.parameters = goal.parameters;
  evaluation.values.resize(goal.parameters.size());
  for (const std::string& fault : {fault_of(goal), fault_of(evaluation)}) {
    EXPECT_NE(fault.find("more names than there are parameters"), std::string::npos) << fault;
    EXPECT_NE(fault.find("200000 names"), std::string::npos) << fault;
  }
}

TEST(ARequest, OfMoreValuesThanThereAreParametersIsRefusedAtOnce) {
  OptimizeGoal goal;
  goal.start.resize(1000000);
  EXPECT_NE(fault_of(goal).find("more values than there are parameters"), std::string::npos)
      << fault_of(goal);
  EvaluateRequest evaluation;
  evaluation.values.resize(1000000);
  EXPECT_NE(fault_of(evaluation).find("1000000 values"), std::string::npos) << fault_of(evaluation);
}

TEST(ARequest, WithANameThatIsTooLongShowsItsBeginning) {
  OptimizeGoal goal;
  goal.parameters = {std::string(50000, 'a')};
  EXPECT_LT(fault_of(goal).size(), 200U);
  goal.parameters = {};
  goal.algorithm = std::string(1000000, 'l');
  EXPECT_LT(fault_of(goal).size(), 200U);
  EvaluateRequest evaluation;
  evaluation.check = std::string(1000000, 'c');
  EXPECT_LT(fault_of(evaluation).size(), 200U);
}

TEST(PathOfAJob, LiesInTheOutputDirectory) {
  const TemporaryDirectory directory;
  const std::string folder = std::filesystem::canonical(directory.path()).string();
  EXPECT_EQ(path_in(folder, "arm_1"), folder + "/arm_1");
  EXPECT_EQ(path_in(folder, folder + "/arm_1.bag"), folder + "/arm_1.bag");
  for (const std::string& outside : {std::string("../arm_1"), std::string("/etc/passwd"), folder,
                                     folder + "_other/arm_1", std::string(".")})
    EXPECT_THROW(path_in(folder, outside), InputError) << outside;
}

TEST(ARequest, FailsWithTheCodeOfWhatIsThrown) {
  const auto code_of = [](const std::function<void()>& work) {
    const auto failure = failure_of(work);
    return failure ? failure->code + ": " + failure->message : "";
  };
  EXPECT_EQ(code_of([] {}), "");
  EXPECT_EQ(code_of([] { throw OutputError("a", "full"); }),
            "output_failed: a: cannot be written: full");
  EXPECT_EQ(code_of([] { throw JobIsRunning("there"); }), "busy: there");
  EXPECT_EQ(code_of([] { throw ReadingCancelled(); }), "cancelled: cancelled");
  EXPECT_EQ(code_of([] { throw std::logic_error("odd"); }), "internal_error: odd");
  EXPECT_EQ(code_of([] {
              throw InputError({{"request", 0}, "check", "no", "", ""});
            }).find("bad_input: "),
            0U);
}

}  // namespace
}  // namespace codesign
