// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "engine/mpi_engine.h"
#include "engine/rank_fixture.h"
#include "engine/thread_engine.h"
#include "ensemble/ensemble.h"
#include "ensemble/ensemble_fixture.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

std::vector<EvaluationTask> block_tasks(const Problem& problem, int count) {
  std::vector<EvaluationTask> result;
  for (int k = 0; k < count; ++k)
    result.push_back({system_of(problem), problem.parameters(Eigen::Vector2d(10.0 + k, 3.0)),
                      gradient_if(k % 3 != 0)});
  return result;
}

void expect_the_same(const std::vector<Evaluation>& a, const std::vector<Evaluation>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_TRUE(a[k].status.ok()) << a[k].status.cause;
    EXPECT_EQ(a[k].objective, b[k].objective);
    EXPECT_EQ(a[k].gradient, b[k].gradient);
    EXPECT_EQ(a[k].statistics.energy_error, b[k].statistics.energy_error);
    EXPECT_EQ(a[k].events.count, b[k].events.count);
    EXPECT_EQ(a[k].events.order, b[k].events.order);
    ASSERT_EQ(a[k].events.list.size(), b[k].events.list.size());
    for (std::size_t e = 0; e < a[k].events.list.size(); ++e)
      EXPECT_EQ(a[k].events.list[e].time, b[k].events.list[e].time);
  }
}

/// A block with a run so long that the test cannot wait for its end.
Problem endless_block() {
  SourceText study = block("").study_text();
  study.text.replace(study.text.find("duration: 0.8"), 13, "duration: 1.0e+9");
  study.text.replace(study.text.find("setpoint: 0.5"), 13,
                     "setpoint: {type: sine, amplitude: 0.5, frequency: 20.0}");
  study.text += "solver: {maximum_steps: 1000000000}\n";
  return load_problem(block("").urdf(), {}, study);
}

TEST(MpiEngine, AnyNumberOfRanksGivesTheSameBits) {
  const Problem problem = block("");
  const std::vector<EvaluationTask> all = block_tasks(problem, 23);
  const std::vector<Evaluation> expected = SerialEngine().evaluate(all, nullptr);
  for (const int ranks : {2, 3, 5}) {
    RankJob job(ranks);
    MpiEngine engine(job.ranks(), problem);
    EXPECT_EQ(engine.workers(), ranks) << "rank 0 computes as well";
    expect_the_same(engine.evaluate(all, nullptr), expected);
    expect_the_same(engine.evaluate(all, nullptr), expected);
    EXPECT_TRUE(engine.evaluate({}, nullptr).empty());
  }
}

TEST(MpiEngine, EventsAndEndsOfRunsAreTheSameByThreadsAndRanks) {
  const Problem problem = block(
      "loads: [{joint: slide, effort: \"${slide/position > 0.2 ? -3.0 : 0.0}\"}]\n"
      "until: \"${slide/velocity < 0.3}\"\n");
  const std::vector<EvaluationTask> all = block_tasks(problem, 11);
  const std::vector<Evaluation> expected = SerialEngine().evaluate(all, nullptr);
  EXPECT_GT(expected.front().events.count, 0);
  for (const int workers : {2, 3}) {
    ThreadEngine threads(workers);
    expect_the_same(threads.evaluate(all, nullptr), expected);
    RankJob job(workers);
    MpiEngine ranks(job.ranks(), problem);
    expect_the_same(ranks.evaluate(all, nullptr), expected);
  }
}

TEST(MpiEngine, RunsAndLawsAreSystemsOfTheirOwnOnEveryRank) {
  const Problem problem = block(kRunsAndLaws);
  const Ensemble alone(problem);
  RankJob job(3);
  const Ensemble spread(problem, 1, {nullptr, nullptr, job.ranks()});
  const EnsembleEvaluation here = alone.evaluate(problem.start(), true),
                           there = spread.evaluate(problem.start(), true);
  ASSERT_TRUE(here.total.status.ok());
  EXPECT_EQ(here.total.objective, there.total.objective);
  EXPECT_EQ(here.total.gradient, there.total.gradient);
  EXPECT_EQ(here.values, there.values);
}

TEST(MpiEngine, SeveralCallersAndSeveralProblemsShareTheRanks) {
  const Problem problem = block(""), other = with_settings(problem, {{"mu", 0.2}});
  const std::vector<EvaluationTask> all = block_tasks(problem, 7), others = block_tasks(other, 5);
  const std::vector<Evaluation> expected = SerialEngine().evaluate(all, nullptr),
                                expected_others = SerialEngine().evaluate(others, nullptr);
  EXPECT_NE(expected[1].objective, expected_others[1].objective);
  RankJob job(3);
  MpiEngine engine(job.ranks(), problem);
  std::vector<std::vector<Evaluation>> results(4);
  std::vector<std::thread> callers;
  for (auto& result : results)
    callers.emplace_back([&] { result = engine.evaluate(all, nullptr); });
  callers.emplace_back([&] {
    expect_the_same(MpiEngine(job.ranks(), other).evaluate(others, nullptr), expected_others);
  });
  for (std::thread& caller : callers) caller.join();
  for (const auto& result : results) expect_the_same(result, expected);
}

TEST(MpiEngine, EachFinishedTaskIsToldOnce) {
  const Problem problem = block("");
  std::vector<EvaluationTask> all = block_tasks(problem, 12);
  std::vector<std::atomic<int>> told(all.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    all[k].finished = [&told, k](const Evaluation&) { ++told[k]; };
  RankJob job(3);
  MpiEngine(job.ranks(), problem).evaluate(all, nullptr);
  for (const std::atomic<int>& count : told) EXPECT_EQ(count, 1);
}

TEST(MpiEngine, ACancelReachesEvaluationsThatRun) {
  const Problem problem = endless_block(), quick = block("");
  RankJob job(3);
  {
    MpiEngine engine(job.ranks(), problem);
    std::atomic<bool> cancel{false};
    std::thread canceller([&] {
      EXPECT_TRUE(comes_true([&job] { return job.taken() >= 2; })) << "both ranks compute";
      cancel = true;
    });
    for (const Evaluation& evaluation : engine.evaluate(block_tasks(problem, 9), &cancel))
      EXPECT_EQ(evaluation.status.code, StatusCode::kCancelled) << evaluation.status.cause;
    canceller.join();
  }
  const std::vector<EvaluationTask> all = block_tasks(quick, 5);
  expect_the_same(MpiEngine(job.ranks(), quick).evaluate(all, nullptr),
                  SerialEngine().evaluate(all, nullptr));
}

TEST(MpiEngine, AnExceptionOfAWorkerReachesTheCaller) {
  // Rank 0 is busy with one of the two tasks until the other rank has the other one.
  const Problem problem = endless_block();
  const auto error =
      std::make_exception_ptr(InputError({{"block.yaml", 7}, "path", "too long", "9", "8"}));
  std::atomic<bool> cancel{false};
  PlayedJob job(own_hello(),
                [&](MessageKind kind, std::uint64_t number) -> std::optional<std::string> {
                  if (kind == MessageKind::kPing) return write_numbered(MessageKind::kPong, number);
                  if (kind != MessageKind::kTask) return std::nullopt;
                  cancel = true;
                  return write_error(number, error);
                });
  job.wait_for_hello();
  try {
    MpiEngine(job.ranks(), problem).evaluate(block_tasks(problem, 2), &cancel);
    ADD_FAILURE() << "no exception";
  } catch (const InputError& caught) {
    EXPECT_STREQ(caught.what(), "block.yaml:7: path: too long (value: 9, allowed: 8)");
  }
}

/// Plays rank 0.
class RankWorkerTest : public testing::Test {
 protected:
  explicit RankWorkerTest(const RankTimes& times = patient_times())
      : worker_([this, times] { fault_ = RankWorker(&theirs_, times).run(); }) {}
  ~RankWorkerTest() override {
    if (worker_.joinable()) end();
  }
  void say(std::string bytes) { mail_.send(0, 1, std::move(bytes)); }
  /// The next message that is no sign of life.
  std::string hear() {
    for (;;) {
      std::optional<Envelope> envelope = mail_.receive(0);
      if (envelope && ByteReader(envelope->bytes).get<MessageKind>() != MessageKind::kSign)
        return envelope->bytes;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  }
  void end() {
    say(write_numbered(MessageKind::kEnd));
    worker_.join();
  }

  Mail mail_{2};
  MailTransport theirs_{&mail_, 1};
  std::string fault_;
  std::thread worker_;
};

TEST_F(RankWorkerTest, SaysHelloAnswersAndSaysGoodbye) {
  const std::string first = hear();
  ByteReader reader(first);
  EXPECT_EQ(reader.get<MessageKind>(), MessageKind::kHello);
  const Hello hello = read_hello(&reader);
  EXPECT_EQ(hello.version, version());
  EXPECT_FALSE(hello.host.empty());
  const Problem problem = block("");
  say(write_problem(5, make_portable(problem)));
  say(write_task(77, 5, 0, Derivatives::kGradient, problem.parameters()));
  const std::string answer = hear();
  ByteReader result(answer);
  EXPECT_EQ(result.get<MessageKind>(), MessageKind::kResult);
  EXPECT_EQ(result.get<std::uint64_t>(), 77U);
  const Evaluation expected =
      SerialEngine()
          .evaluate({{system_of(problem), problem.parameters(), Derivatives::kGradient}}, nullptr)
          .front();
  EXPECT_EQ(read_result(&result).gradient, expected.gradient);
  say(write_numbered(MessageKind::kPing, 3));
  EXPECT_EQ(hear(), write_numbered(MessageKind::kPong, 3));
  say(write_numbered(MessageKind::kEnd));
  EXPECT_EQ(hear(), write_numbered(MessageKind::kGoodbye));
  worker_.join();
  EXPECT_EQ(fault_, "");
}

TEST_F(RankWorkerTest, WhatItCannotDoItAnswersWithTheException) {
  hear();
  PortableProblem broken = make_portable(block(""));
  broken.study.text = "duration: soon";
  say(write_problem(1, broken));
  for (const std::uint32_t problem : {1U, 2U}) {
    say(write_task(9, problem, 0, Derivatives::kNone, {}));
    const std::string answer = hear();
    ByteReader reader(answer);
    EXPECT_EQ(reader.get<MessageKind>(), MessageKind::kError);
    reader.get<std::uint64_t>();
    if (problem == 1)
      EXPECT_THROW(std::rethrow_exception(read_error(&reader)), InputError);
    else
      EXPECT_THROW(std::rethrow_exception(read_error(&reader)), std::runtime_error)
          << "a problem that it was not sent";
  }
}

TEST_F(RankWorkerTest, AProblemIsForgotten) {
  hear();
  const Problem problem = block("");
  say(write_problem(1, make_portable(problem)));
  say(write_numbered(MessageKind::kForget, 1));
  say(write_task(4, 1, 0, Derivatives::kNone, problem.parameters()));
  EXPECT_EQ(ByteReader(hear()).get<MessageKind>(), MessageKind::kError);
}

class OrphanTest : public RankWorkerTest {
 protected:
  OrphanTest() : RankWorkerTest(times()) {}
  static RankTimes times() {
    RankTimes times;
    times.sign = std::chrono::milliseconds(500);
    times.orphaned = std::chrono::seconds(5);
    // A clock that goes on whenever it is read.
    times.now = [passed = std::make_shared<std::atomic<int>>(0)] {
      return PollPause::Clock::time_point(std::chrono::milliseconds(*passed += 20));
    };
    return times;
  }
};

TEST_F(OrphanTest, WithoutRankZeroItEnds) {
  worker_.join();
  EXPECT_EQ(fault_, "rank 0 has said nothing for too long");
  EXPECT_EQ(ByteReader(hear()).get<MessageKind>(), MessageKind::kHello);
  int signs = 0;
  while (mail_.receive(0)) ++signs;
  EXPECT_GT(signs, 0) << "signs of life";
}

}  // namespace

}  // namespace codesign
