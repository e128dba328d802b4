// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply/gain_ramp.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "text/number_text.h"

namespace codesign {
namespace {

using Clock = std::chrono::steady_clock;

/// Pause between two calls of the guard.
constexpr std::chrono::milliseconds kGlance{2};

Clock::duration seconds(double value) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(value));
}

}  // namespace

bool RampOutcome::is_known() const {
  return std::all_of(now.begin(), now.end(),
                     [](const GainServer::Answer& answer) { return answer.has_value(); });
}

GainRamp::GainRamp(std::vector<RampServer> servers, const RampOptions& options, Guard guard)
    : servers_(std::move(servers)),
      options_(options),
      guard_(std::move(guard)),
      sent_(servers_.size()) {}

RampOutcome GainRamp::run() {
  for (const RampServer& one : servers_) outcome_.now.emplace_back(one.before);
  const int steps = std::max(1, static_cast<int>(std::ceil(options_.ramp / options_.step)));
  const Time start = Clock::now();
  bool goes_on = wait_until(start);
  for (int step = 1; goes_on && step <= steps; ++step)
    goes_on = send_step(static_cast<double>(step) / steps) &&
              wait_until(start + seconds(step * options_.ramp / steps));
  if (goes_on) goes_on = wait_until(Clock::now() + seconds(options_.hold));
  if (!goes_on) roll_back();
  return outcome_;
}

bool GainRamp::send_step(double share) {
  std::vector<GainValues> sent;
  for (const RampServer& one : servers_) sent.push_back(between(one.before, one.after, share));
  for (std::size_t k = 0; k < servers_.size(); ++k) send(k, sent[k]);
  return wait_for_step() && confirm(sent);
}

void GainRamp::send(std::size_t server, const GainValues& values) {
  const auto answered = std::make_shared<std::promise<GainServer::Answer>>();
  sent_[server] = {answered, answered->get_future().share()};
  servers_[server].server->send(
      values, [answered](const GainServer::Answer& answer) { answered->set_value(answer); });
}

/// Whether the last request of every server has been answered within a time.
bool GainRamp::wait_for_answers(Clock::duration longest) const {
  const Time end = Clock::now() + longest;
  return std::all_of(sent_.begin(), sent_.end(), [end](const Request& request) {
    return !request.was_sent() || request.answer.wait_until(end) == std::future_status::ready;
  });
}

/// False as soon as the guard gives an alarm.
bool GainRamp::wait_until(Time end) {
  do {
    alarm_ = guard_();
    if (alarm_) return false;
    const Time now = Clock::now();
    if (now >= end) return true;
    std::this_thread::sleep_for(std::min<Clock::duration>(kGlance, end - now));
  } while (true);
}

bool GainRamp::wait_for_step() {
  const Time end = Clock::now() + seconds(options_.patience);
  while (!wait_for_answers(kGlance)) {
    alarm_ = guard_();
    if (alarm_) return false;
    if (Clock::now() >= end) break;
  }
  return true;
}

bool GainRamp::confirm(const std::vector<GainValues>& sent) {
  for (std::size_t k = 0; k < servers_.size(); ++k) {
    const std::string& name = servers_[k].server->name();
    const GainServer::Answer answer = sent_[k].last();
    if (!answer)
      alarm_ = RampAlarm{sent_[k].is_answered() ? name + " has refused the values or is gone"
                                                : name + " has not answered within " +
                                                      to_decimal(options_.patience) + " s"};
    else if (const std::string difference = altered(sent[k], *answer); !difference.empty())
      alarm_ = RampAlarm{name + " has altered the values: " + difference};
    if (alarm_) return false;
    outcome_.now[k] = sent[k];
  }
  return true;
}

void GainRamp::roll_back() {
  outcome_.alarm = alarm_->sentence;
  for (std::size_t k = 0; k < servers_.size(); ++k)
    if (sent_[k].was_sent()) {
      outcome_.now[k].reset();
      send(k, servers_[k].before);
    }
  if (std::none_of(sent_.begin(), sent_.end(),
                   [](const Request& request) { return request.was_sent(); }))
    return;
  if (!wait_for_answers(seconds(options_.grace))) {
    for (std::size_t k = 0; k < servers_.size(); ++k)
      if (sent_[k].was_sent() && !sent_[k].is_answered()) servers_[k].server->overtake();
    wait_for_answers(seconds(options_.rollback_patience));
  }
  outcome_.rollback_seconds = std::chrono::duration<double>(Clock::now() - alarm_->since).count();
  for (std::size_t k = 0; k < servers_.size(); ++k) {
    const GainServer::Answer answer = sent_[k].last();
    if (answer && altered(servers_[k].before, *answer).empty())
      outcome_.now[k] = servers_[k].before;
  }
}

GainValues between(const GainValues& before, const GainValues& after, double share) {
  if (share >= 1.0) return after;
  GainValues values;
  for (const auto& [name, value] : after) {
    const double from = before.at(name).number;
    values[name] = value.is_flag ? value : GainValue{from + (value.number - from) * share, false};
  }
  return values;
}

std::string altered(const GainValues& sent, const GainValues& answer) {
  for (const auto& [name, value] : sent) {
    const auto found = answer.find(name);
    if (found == answer.end())
      return name + " = " + to_decimal(value.number) + " was sent, and it has no " + name;
    if (!(found->second == value))
      return name + " = " + to_decimal(value.number) + " was sent, and it has " +
             to_decimal(found->second.number);
  }
  return "";
}

}  // namespace codesign
