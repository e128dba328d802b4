// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Jobs whose ranks are lost; the tests of MpiEngine have ranks that answer. The test plays the
// other rank, computes for rank 0, and moves the clock of the ranks, so that no wait depends on the
// machine.
#include "engine/dispatcher.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

#include "engine/mpi_engine.h"
#include "engine/rank_fixture.h"
#include "ensemble/ensemble_fixture.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr auto kNobody = [](MessageKind, std::uint64_t) { return std::optional<std::string>(); };
constexpr std::chrono::seconds kSilence{2};

std::vector<EvaluationTask> equal_tasks(const Problem& problem, int count) {
  return std::vector<EvaluationTask>(
      static_cast<std::size_t>(count),
      {system_of(problem), problem.parameters(), Derivatives::kGradient});
}

/// A clock that stands still until it is moved.
class TestClock {
 public:
  RankTimes times() {
    RankTimes times;
    times.first_sign = times.silence = kSilence;
    times.sign = std::chrono::milliseconds(500);
    times.now = [this] { return start_ + std::chrono::milliseconds(passed_ += step_); };
    return times;
  }
  void move(int milliseconds) { passed_ += milliseconds; }
  /// From now on it goes on whenever it is read.
  void run() { step_ = 20; }

 private:
  const PollPause::Clock::time_point start_ = PollPause::Clock::now();
  std::atomic<int> passed_{0}, step_{0};
};

/// Some tasks, whose results come from the other rank and from the test.
struct PlayedBatch {
  PlayedBatch(Dispatcher* dispatcher, const Problem& problem, int count,
              const std::atomic<bool>* cancel = nullptr)
      : ranks(dispatcher),
        tasks(equal_tasks(problem, count)),
        number(ranks->add(make_portable(problem))),
        batch{tasks, std::vector<std::uint32_t>(tasks.size(), 0), number, cancel} {}
  ~PlayedBatch() { ranks->remove(number); }

  /// @returns the results.
  std::vector<Evaluation> run() {
    std::vector<Evaluation> results;
    ranks->run(&batch, [&results](std::size_t, Evaluation one) { results.push_back(one); });
    return results;
  }

  Dispatcher* const ranks;
  const std::vector<EvaluationTask> tasks;
  const std::uint32_t number;
  RankBatch batch;
};

std::string late_answer(std::uint64_t task) {
  Evaluation late;
  late.objective = 7.0;
  return write_result(task, late);
}

TEST(Dispatcher, AProgramThatRunsAloneHasOneRank) {
  Dispatcher alone(nullptr);
  EXPECT_EQ(alone.ranks(), 1);
  EXPECT_TRUE(alone.lost().ok());
  EXPECT_TRUE(alone.finish());
}

TEST(Dispatcher, ARankThatFallsSilentEndsTheJobWithItsName) {
  const Problem problem = block("");
  TestClock clock;
  std::promise<void> has_task;
  PlayedJob job(
      own_hello(),
      [&has_task](MessageKind kind, std::uint64_t) {
        if (kind == MessageKind::kTask) has_task.set_value();
        return std::optional<std::string>();
      },
      clock.times());
  job.wait_for_hello();
  PlayedBatch batch(job.ranks(), problem, 2);
  std::thread rank_zero([&] {
    has_task.get_future().wait();
    const auto [taken, index] = job.ranks()->take_local(batch.number);
    job.ranks()->give_local(taken, index, {}, nullptr);
    clock.run();
  });
  EXPECT_EQ(batch.run().size(), 1U) << "what rank 0 computed is there";
  rank_zero.join();
  EXPECT_EQ(batch.batch.ended.code, StatusCode::kWorkerLost);
  const std::string& cause = batch.batch.ended.cause;
  EXPECT_NE(cause.find("rank 1 of 2 on host elsewhere has said nothing for 2 s"), std::string::npos)
      << cause;
  EXPECT_EQ(job.ranks()->lost().code, StatusCode::kWorkerLost);
  // The next call does not wait again, or rank 0 would compute meanwhile.
  for (const Evaluation& one :
       MpiEngine(job.ranks(), problem).evaluate(equal_tasks(problem, 2), nullptr))
    EXPECT_EQ(one.status.code, StatusCode::kWorkerLost);
  EXPECT_FALSE(job.ranks()->finish());
}

TEST(Dispatcher, ARankThatGivesSignsOfLifeIsWaitedFor) {
  const Problem problem = block("");
  TestClock clock;
  std::optional<std::uint64_t> task;
  int signs = 0;
  PlayedJob job(
      own_hello(),
      [&](MessageKind kind, std::uint64_t number) -> std::optional<std::string> {
        if (kind == MessageKind::kTask) task = number;
        if (!task) return std::nullopt;
        // The dispatcher's own signs of life drive the answers: three times the longest silence.
        clock.move(600);
        if (++signs < 10) return write_numbered(MessageKind::kSign);
        return late_answer(*task);
      },
      clock.times());
  job.wait_for_hello();
  PlayedBatch batch(job.ranks(), problem, 1);
  const std::vector<Evaluation> results = batch.run();
  ASSERT_EQ(results.size(), 1U) << batch.batch.ended.cause;
  EXPECT_EQ(results[0].objective, 7.0);
  EXPECT_TRUE(job.ranks()->lost().ok());
}

TEST(Dispatcher, AfterACancelARankThatDoesNotAnswerCountsAsLost) {
  const Problem problem = block("");
  for (const bool answers : {false, true}) {
    std::atomic<bool> cancel{false};
    TestClock clock;
    const auto part = [&](MessageKind kind, std::uint64_t number) -> std::optional<std::string> {
      if (kind == MessageKind::kTask) cancel = true;
      if (kind != MessageKind::kPing) return std::nullopt;
      if (answers) return write_numbered(MessageKind::kPong, number);
      // The time for an answer passes, and not that after which a silent rank is lost for good.
      clock.move(400);
      return std::nullopt;
    };
    PlayedJob job(own_hello(), part, clock.times());
    job.wait_for_hello();
    PlayedBatch batch(job.ranks(), problem, 1, &cancel);
    EXPECT_TRUE(batch.run().empty());
    EXPECT_EQ(batch.batch.ended.code, answers ? StatusCode::kCancelled : StatusCode::kWorkerLost);
    EXPECT_TRUE(job.ranks()->lost().ok()) << "it may have been busy otherwise";
  }
}

TEST(Dispatcher, CallsTheRoll) {
  EXPECT_TRUE(Dispatcher(nullptr).call_roll().ok());
  {
    RankJob job(3);
    EXPECT_TRUE(job.ranks()->call_roll().ok());
  }
  PlayedJob silent(own_hello(), kNobody);
  silent.wait_for_hello();
  const Status missed = silent.ranks()->call_roll();
  EXPECT_EQ(missed.code, StatusCode::kWorkerLost);
  EXPECT_EQ(missed.cause,
            "rank 1 of 2 on host elsewhere does not answer: it was killed, or its machine cannot "
            "be reached");
}

TEST(Dispatcher, AnotherVersionOfTheProgramIsRefused) {
  const Problem problem = block("");
  Hello hello = own_hello();
  hello.version = "0.0.1";
  PlayedJob job(hello, kNobody);
  while (job.ranks()->lost().ok()) std::this_thread::yield();
  const Evaluation one =
      MpiEngine(job.ranks(), problem).evaluate(equal_tasks(problem, 1), nullptr).front();
  EXPECT_EQ(one.status.code, StatusCode::kWorkerLost);
  EXPECT_NE(one.status.cause.find("on host elsewhere runs version 0.0.1"), std::string::npos)
      << one.status.cause;
}

TEST(Dispatcher, AConnectionThatFailsIsNamed) {
  const Problem problem = block("");
  Mail mail(2);
  MailTransport transport(&mail, 0);
  transport.failure_ = "the cable is cut";
  Dispatcher dispatcher(&transport);
  PlayedBatch batch(&dispatcher, problem, 1);
  EXPECT_TRUE(batch.run().empty());
  EXPECT_EQ(batch.batch.ended.cause, "the cable is cut");
}

}  // namespace
}  // namespace codesign
