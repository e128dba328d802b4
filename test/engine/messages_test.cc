// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/messages.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "mechanism_codesign/error.h"

namespace codesign {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(),
                 kNan = std::numeric_limits<double>::quiet_NaN();

Evaluation full_evaluation() {
  Evaluation evaluation;
  evaluation.status = {StatusCode::kUnstableMotion, 0.1, "it ran away"};
  evaluation.objective = 1.0 / 3.0;
  evaluation.gradient = Eigen::Vector3d(-0.0, kInfinity, std::numeric_limits<double>::denorm_min());
  evaluation.jacobian_root = (Eigen::MatrixXd(2, 2) << 1, -0.0, 0, kInfinity).finished();
  evaluation.extremes.values = Eigen::Vector2d(kNan, -kInfinity);
  evaluation.extremes.times = Eigen::Vector2d(0.25, 1e300);
  evaluation.extremes.gradients = (Eigen::MatrixXd(3, 2) << 1, 2, 3, 4, 5, 6).finished();
  evaluation.statistics = {123456789012, 7, 0.5, 1e-9, kNan, 5};
  evaluation.warnings = {{"drift", "it drifts", {"a.yaml", 3}}, {"two", "", {}}};
  evaluation.events = {{{0.5, "loads[0].effort", "slide", "t < 1", true, false}}, 7, "abc"};
  return evaluation;
}

/// The fields after kind and number.
ByteReader body_of(const std::string& message, MessageKind kind, std::uint64_t number) {
  ByteReader reader(message);
  EXPECT_EQ(reader.get<MessageKind>(), kind);
  EXPECT_EQ(reader.get<std::uint64_t>(), number);
  return reader;
}

TEST(Messages, AnEvaluationKeepsItsBits) {
  const std::string message = write_result(42, full_evaluation());
  ByteReader reader = body_of(message, MessageKind::kResult, 42);
  const Evaluation back = read_result(&reader);
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(write_result(42, back), message) << "all bytes, NaN and signs of zeros with them";
  EXPECT_EQ(back.status.cause, "it ran away");
  EXPECT_EQ(back.jacobian_root, full_evaluation().jacobian_root);
  EXPECT_EQ(back.extremes.gradients, full_evaluation().extremes.gradients);
  EXPECT_TRUE(std::signbit(back.gradient[0]));
  EXPECT_EQ(back.warnings[0].where.line, 3);
  EXPECT_EQ(back.events.count, 7);
  EXPECT_EQ(back.events.order, "abc");
  ASSERT_EQ(back.events.list.size(), 1u);
  EXPECT_EQ(describe(back.events.list[0]), "loads[0].effort, \"t < 1\", rising, a kink");
  const std::string empty = write_result(0, {});
  ByteReader of_empty = body_of(empty, MessageKind::kResult, 0);
  EXPECT_EQ(read_result(&of_empty).gradient.size(), 0);
}

TEST(Messages, ATaskKeepsItsBits) {
  const std::string message =
      write_task(7, 3, 2, Derivatives::kGaussNewton, {0.1, -0.0, kInfinity});
  ByteReader reader = body_of(message, MessageKind::kTask, 7);
  const TaskMessage task = read_task(7, &reader);
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(task.problem, 3U);
  EXPECT_EQ(task.system, 2U);
  EXPECT_EQ(task.derivatives, Derivatives::kGaussNewton);
  EXPECT_EQ(task.parameters, (std::vector<double>{0.1, -0.0, kInfinity}));
  EXPECT_EQ(write_task(7, 3, 2, Derivatives::kGaussNewton, task.parameters), message);
  EXPECT_EQ(task.steps.method, RunSteps::Method::kOwn);
}

TEST(Messages, ATaskKeepsItsSteps) {
  const std::string message =
      write_task(7, 3, 2, Derivatives::kNone, {0.1}, {RunSteps::Method::kDopri5, true, 4000});
  ByteReader reader = body_of(message, MessageKind::kTask, 7);
  const TaskMessage task = read_task(7, &reader);
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(task.steps.method, RunSteps::Method::kDopri5);
  EXPECT_TRUE(task.steps.is_second);
  EXPECT_EQ(task.steps.most, 4000);
}

TEST(Messages, AProblemArrivesWhole) {
  PortableProblem problem{{"a.urdf", "<robot/>"},
                          {{"b.urdf", "1"}, {"c.urdf", ""}},
                          {"d.yaml", "x: 1"},
                          {},
                          {},
                          {1.5, 2.5},
                          {"p", "q"}};
  problem.trajectories = {{"e.bag", "/t", "j", {{0, 1}, {2, 3}, {}, {}}}};
  problem.files = {{"i.json", {"folder/i.json", "{}"}}};
  const std::string message = write_problem(9, problem);
  ByteReader reader = body_of(message, MessageKind::kProblem, 9);
  const PortableProblem back = read_problem(&reader);
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(write_problem(9, back), message);
  EXPECT_EQ(back.overlays[1].name, "c.urdf");
  EXPECT_EQ(back.trajectories[0].trajectory.positions, (std::vector<double>{2, 3}));
  ASSERT_EQ(back.files.size(), 1U);
  EXPECT_EQ(back.files[0].file, "i.json");
  EXPECT_EQ(back.files[0].source.name, "folder/i.json");
  EXPECT_EQ(back.files[0].source.text, "{}");
  EXPECT_EQ(back.tuned, problem.tuned);
}

TEST(Messages, ExceptionsKeepTheirKindAndSentence) {
  const auto back = [](const std::exception_ptr& error) {
    const std::string message = write_error(1, error);
    ByteReader reader = body_of(message, MessageKind::kError, 1);
    return read_error(&reader);
  };
  const InputError input({{"a.yaml", 12}, "objective", "no such signal", "foo", "bar"});
  try {
    std::rethrow_exception(back(std::make_exception_ptr(input)));
  } catch (const InputError& caught) {
    EXPECT_STREQ(caught.what(), input.what());
  }
  try {
    std::rethrow_exception(back(std::make_exception_ptr(std::out_of_range("too far"))));
  } catch (const std::runtime_error& caught) {
    EXPECT_STREQ(caught.what(), "too far");
  }
  EXPECT_THROW(std::rethrow_exception(back(std::make_exception_ptr(3))), std::runtime_error);
}

TEST(Messages, HelloIsReadByOtherVersions) {
  const std::string message = write_hello({4, "0.9.1", "alpha"});
  ByteReader reader(message);
  EXPECT_EQ(reader.get<MessageKind>(), MessageKind::kHello);
  const Hello hello = read_hello(&reader);
  EXPECT_EQ(hello.format, 4U);
  EXPECT_EQ(hello.version, "0.9.1");
  EXPECT_EQ(hello.host, "alpha");
}

TEST(Messages, OneThatEndsTooEarlyIsRefused) {
  const std::string message = write_result(42, full_evaluation());
  for (std::size_t size = 9; size < message.size(); ++size) {
    const std::string part = message.substr(0, size);
    ByteReader reader = body_of(part, MessageKind::kResult, 42);
    EXPECT_THROW(read_result(&reader), std::runtime_error) << size;
  }
}

}  // namespace
}  // namespace codesign
