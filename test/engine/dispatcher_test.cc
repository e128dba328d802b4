// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Jobs whose ranks are lost; the tests of MpiEngine have ranks that answer.
#include "engine/dispatcher.h"

#include <gtest/gtest.h>

#include <deque>

#include "engine/mpi_engine.h"
#include "engine/rank_fixture.h"
#include "ensemble/ensemble_fixture.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr auto kNobody = [](MessageKind, std::uint64_t) { return std::optional<std::string>(); };

std::vector<EvaluationTask> equal_tasks(const Problem& problem, int count) {
  return std::vector<EvaluationTask>(
      static_cast<std::size_t>(count),
      {system_of(problem), problem.parameters(), Derivatives::kGradient});
}

constexpr std::chrono::seconds kSilence{2};

RankTimes short_times() {
  RankTimes times;
  times.first_sign = times.silence = kSilence;
  times.sign = std::chrono::milliseconds(50);
  return times;
}

/// The statuses other than success that come out, which are all the same, and how many tasks
/// succeeded.
std::pair<Status, int> outcome_of(const std::vector<Evaluation>& results) {
  std::pair<Status, int> outcome;
  for (const Evaluation& one : results)
    if (one.status.ok())
      ++outcome.second;
    else
      outcome.first = one.status;
  return outcome;
}

TEST(Dispatcher, AProgramThatRunsAloneHasOneRank) {
  Dispatcher alone(nullptr);
  EXPECT_EQ(alone.ranks(), 1);
  EXPECT_TRUE(alone.lost().ok());
  EXPECT_TRUE(alone.finish());
}

TEST(Dispatcher, ARankThatFallsSilentEndsTheJobWithItsName) {
  const Problem problem = block("");
  PlayedJob job(own_hello(), kNobody, short_times());
  const auto [status, succeeded] =
      outcome_of(MpiEngine(job.ranks(), problem).evaluate(equal_tasks(problem, 8), nullptr));
  EXPECT_EQ(status.code, StatusCode::kWorkerLost);
  EXPECT_NE(status.cause.find("rank 1 of 2 on host elsewhere has said nothing for"),
            std::string::npos)
      << status.cause;
  EXPECT_GE(succeeded, 1) << "what rank 0 computed is there";
  EXPECT_EQ(job.ranks()->lost().code, StatusCode::kWorkerLost);
  // The next call does not wait again.
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(
      outcome_of(MpiEngine(job.ranks(), problem).evaluate(equal_tasks(problem, 2), nullptr)).second,
      0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, kSilence);
  EXPECT_FALSE(job.ranks()->finish());
}

TEST(Dispatcher, ARankThatGivesSignsOfLifeIsWaitedFor) {
  const Problem problem = block("");
  std::deque<std::uint64_t> tasks;
  const auto begin = std::chrono::steady_clock::now();
  PlayedJob job(
      own_hello(),
      [&](MessageKind kind, std::uint64_t number) -> std::optional<std::string> {
        if (kind == MessageKind::kTask) tasks.push_back(number);
        // The dispatcher's own signs of life drive the answers.
        if (tasks.empty() || std::chrono::steady_clock::now() - begin < 1.5 * kSilence)
          return write_numbered(MessageKind::kSign);
        const std::uint64_t task = tasks.front();
        tasks.pop_front();
        Evaluation late;
        late.objective = 7.0;
        return write_result(task, late);
      },
      short_times());
  job.wait_for_hello();
  std::vector<double> objectives;
  // So many tasks that the other rank gets one even if it is slow.
  for (const Evaluation& one :
       MpiEngine(job.ranks(), problem).evaluate(equal_tasks(problem, 100), nullptr)) {
    EXPECT_TRUE(one.status.ok()) << one.status.cause;
    objectives.push_back(one.objective);
  }
  EXPECT_GE(std::count(objectives.begin(), objectives.end(), 7.0), 1);
}

TEST(Dispatcher, AfterACancelARankThatDoesNotAnswerCountsAsLost) {
  const Problem problem = block("");
  for (const bool answers : {false, true}) {
    std::atomic<bool> cancel{false};
    // So many tasks that the other rank gets one even if it is slow, and that the batch does not
    // end before that rank is pinged.
    const auto part = [answers, &cancel](MessageKind kind, std::uint64_t number) {
      if (kind == MessageKind::kTask) cancel = true;
      return answers && kind == MessageKind::kPing
                 ? std::optional<std::string>(write_numbered(MessageKind::kPong, number))
                 : std::nullopt;
    };
    PlayedJob job(own_hello(), part, answers ? patient_times() : RankTimes{});
    job.wait_for_hello();
    // Rank 0 may be at a task of its own when the cancel comes; that one is cancelled in either
    // case.
    bool has_lost = false;
    for (const Evaluation& one :
         MpiEngine(job.ranks(), problem).evaluate(equal_tasks(problem, 100), &cancel))
      has_lost = has_lost || one.status.code == StatusCode::kWorkerLost;
    EXPECT_EQ(has_lost, !answers);
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
  EXPECT_EQ(outcome_of(MpiEngine(&dispatcher, problem).evaluate(equal_tasks(problem, 400), nullptr))
                .first.cause,
            "the cable is cut");
}

}  // namespace
}  // namespace codesign
