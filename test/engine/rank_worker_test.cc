// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/rank_worker.h"

#include <gtest/gtest.h>

#include "engine/rank_fixture.h"
#include "engine/thread_engine.h"
#include "ensemble/ensemble_fixture.h"

namespace codesign {
namespace {

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
      if (envelope && ByteReader(envelope->bytes).get<MessageKind>() != MessageKind::kSign) return envelope->bytes;
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
  const Evaluation expected = SerialEngine().evaluate({{problem.system(), problem.parameters(), Derivatives::kGradient}}, nullptr).front();
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
      EXPECT_THROW(std::rethrow_exception(read_error(&reader)), std::runtime_error) << "a problem that it was not sent";
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
    times.sign = std::chrono::milliseconds(20);
    times.orphaned = std::chrono::milliseconds(600);
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
