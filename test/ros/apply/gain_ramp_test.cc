// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply/gain_ramp.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

/// A server that answers at once with its present values.
class MockServer : public GainServer {
 public:
  explicit MockServer(std::string name) : name_(std::move(name)) {}

  const std::string& name() const override { return name_; }
  void send(const GainValues& values, std::function<void(const Answer&)> answer) override {
    sent.push_back(values);
    if (is_mute) return late.push_back(std::move(answer));
    if (is_gone) return answer({});
    for (const auto& [key, value] : values) has[key] = value;
    if (has["p"].number > largest) has["p"].number = largest;
    answer(has);
  }
  void overtake() override { ++overtaken; }

  GainValues has = {{"p", {1.0, false}},
                    {"d", {4.0, false}},
                    {"antiwindup", {0.0, true}},
                    {"other", {7.0, false}}};
  std::vector<GainValues> sent;
  std::vector<std::function<void(const Answer&)>> late;
  double largest = 100.0;
  bool is_mute = false, is_gone = false;
  int overtaken = 0;

 private:
  std::string name_;
};

class Ramp : public testing::Test {
 protected:
  RampOutcome run() {
    const RampServer a{&left, before, after}, b{&right, before, after};
    return GainRamp({a, b}, {0.04, 0.01, 0.01, 0.2, 0.01, 0.2}, guard).run();
  }
  std::size_t requests() const { return left.sent.size() + right.sent.size(); }

  const GainValues before = {{"p", {1.0, false}}, {"d", {4.0, false}}, {"antiwindup", {0.0, true}}};
  const GainValues after = {{"p", {3.0, false}}, {"d", {0.1, false}}, {"antiwindup", {1.0, true}}};
  MockServer left{"/left"}, right{"/right"};
  GainRamp::Guard guard = [] { return std::optional<RampAlarm>(); };
};

TEST_F(Ramp, EndsWithTheNewValuesToTheLastBit) {
  const RampOutcome outcome = run();
  EXPECT_EQ(outcome.alarm, "");
  EXPECT_TRUE(std::isnan(outcome.rollback_seconds));
  ASSERT_EQ(left.sent.size(), 4U);
  EXPECT_EQ(right.sent, left.sent);
  EXPECT_EQ(left.sent.back(), after);
  EXPECT_EQ(left.has.at("other").number, 7.0) << "what is not in the plan is left alone";
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(left.sent[k].at("p").number, 1.0 + 2.0 * static_cast<double>(k + 1) / 4.0, 1e-15);
    EXPECT_EQ(left.sent[k].at("antiwindup").number, 1.0) << "from the first step";
  }
  EXPECT_EQ(outcome.now, (std::vector<GainServer::Answer>{after, after}));
}

/// One request to each server takes everything back, wherever the alarm comes.
TEST_F(Ramp, AnAlarmTakesBackOnceAndAtOnce) {
  for (const std::size_t when : {2U, 3U, 4U, 8U}) {
    left = MockServer("/left");
    right = MockServer("/right");
    guard = [this, when]() {
      return requests() >= when ? std::optional<RampAlarm>({"elbow/effort is 9"}) : std::nullopt;
    };
    const RampOutcome outcome = run();
    EXPECT_EQ(outcome.alarm, "elbow/effort is 9");
    EXPECT_EQ(requests(), (when + 1) / 2 * 2 + 2) << "after an alarm at " << when;
    for (const MockServer* server : {&left, &right}) {
      EXPECT_EQ(server->sent.back(), before);
      EXPECT_EQ(server->has.at("p").number, 1.0);
    }
    EXPECT_EQ(outcome.now, (std::vector<GainServer::Answer>{before, before}));
    EXPECT_GE(outcome.rollback_seconds, 0.0);
  }
}

TEST_F(Ramp, AnAlarmBeforeTheFirstStepSendsNothing) {
  guard = [] { return std::optional<RampAlarm>({"too old"}); };
  const RampOutcome outcome = run();
  EXPECT_EQ(outcome.alarm, "too old");
  EXPECT_EQ(requests(), 0U);
  EXPECT_TRUE(outcome.is_known());
}

TEST_F(Ramp, AServerThatClampsEndsIt) {
  right.largest = 2.2;
  const RampOutcome outcome = run();
  EXPECT_EQ(outcome.alarm, "/right has altered the values: p = 2.5 was sent, and it has 2.2");
  EXPECT_EQ(left.sent.size(), 4U) << "three steps and the way back";
  EXPECT_EQ(right.has.at("p").number, 1.0);
  EXPECT_TRUE(outcome.is_known());
}

TEST_F(Ramp, AServerThatIsGoneIsToldAndTheOtherHasItsValues) {
  right.is_gone = true;
  const RampOutcome outcome = run();
  EXPECT_EQ(outcome.alarm, "/right has refused the values or is gone");
  EXPECT_EQ(left.sent.back(), before);
  EXPECT_EQ(outcome.now, (std::vector<GainServer::Answer>{before, std::nullopt}));
}

TEST_F(Ramp, AServerThatDoesNotAnswerHoldsUpNobody) {
  right.is_mute = true;
  RampOutcome outcome = run();
  EXPECT_EQ(outcome.alarm, "/right has not answered within 0.2 s");
  EXPECT_EQ(left.sent.back(), before);
  EXPECT_EQ(right.sent, (std::vector<GainValues>{right.sent.front(), before}))
      << "it gets its values before as soon as it listens again";
  EXPECT_FALSE(outcome.is_known());
  EXPECT_EQ(right.overtaken, 1) << "the way back does not wait for the answer to the step";
  EXPECT_EQ(left.overtaken, 0) << "which has answered";
  for (const auto& answer : right.late) answer(before);  // after the ramp is gone
  // An alarm while the answer is waited for: the other one is taken back without waiting for it.
  left = MockServer("/left");
  int glances = 0;
  guard = [&glances]() {
    return ++glances > 4 ? std::optional<RampAlarm>({"stop"}) : std::nullopt;
  };
  outcome = run();
  EXPECT_EQ(outcome.alarm, "stop");
  EXPECT_EQ(left.sent.size(), 2U);
  EXPECT_EQ(left.sent.back(), before);
}

TEST(Between, GoesFromOneToTheOther) {
  const GainValues before = {{"p", {0.1, false}}, {"on", {1.0, true}}},
                   after = {{"p", {0.3, false}}, {"on", {0.0, true}}};
  EXPECT_EQ(between(before, after, 1.0), after);
  EXPECT_DOUBLE_EQ(between(before, after, 0.5).at("p").number, 0.2);
  EXPECT_EQ(between(before, after, 0.5).at("on").number, 0.0);
}

TEST(Altered, NamesWhatDiffers) {
  const GainValues sent = {{"p", {0.1, false}}};
  EXPECT_EQ(altered(sent, {{"p", {0.1, false}}, {"d", {1.0, false}}}), "");
  EXPECT_EQ(altered(sent, {{"d", {1.0, false}}}), "p = 0.1 was sent, and it has no p");
}

}  // namespace
}  // namespace codesign
