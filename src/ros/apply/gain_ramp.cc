// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply/gain_ramp.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "text/decimal.h"

namespace codesign {
namespace {

using Clock = std::chrono::steady_clock;

/// Pause between two calls of the guard.
constexpr std::chrono::milliseconds kGlance{2};

Clock::duration seconds(double value) { return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(value)); }

}  // namespace

/// The answers to the last request of each server.
class GainRamp::Answers {
 public:
  explicit Answers(std::size_t servers) : slots_(servers) {}

  /// Begins a new request and returns its number.
  int expect(std::size_t server) {
    const std::lock_guard<std::mutex> lock(mutex_);
    slots_[server].is_there = false;
    return ++slots_[server].request;
  }

  /// Answers to older requests are ignored.
  void put(std::size_t server, int request, const GainServer::Answer& answer) {
    const std::lock_guard<std::mutex> lock(mutex_);
    Slot& slot = slots_[server];
    if (slot.request != request) return;
    slot.answer = answer;
    slot.is_there = true;
    changed_.notify_all();
  }

  bool wait(Clock::duration longest) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, longest, [this] {
      return std::all_of(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.is_there || slot.request == 0; });
    });
  }

  bool is_there(std::size_t server) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return slots_[server].is_there;
  }

  GainServer::Answer of(std::size_t server) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return slots_[server].is_there ? slots_[server].answer : GainServer::Answer();
  }

 private:
  struct Slot {
    int request = 0;
    bool is_there = false;
    GainServer::Answer answer;
  };
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Slot> slots_;
};

bool RampOutcome::is_known() const {
  return std::all_of(now.begin(), now.end(), [](const GainServer::Answer& answer) { return answer.has_value(); });
}

GainRamp::GainRamp(std::vector<RampServer> servers, const RampOptions& options, Guard guard)
    : servers_(std::move(servers)),
      options_(options),
      guard_(std::move(guard)),
      answers_(std::make_shared<Answers>(servers_.size())),
      was_sent_(servers_.size(), false) {}

GainRamp::~GainRamp() = default;

RampOutcome GainRamp::run() {
  for (const RampServer& one : servers_) outcome_.now.emplace_back(one.before);
  const int steps = std::max(1, static_cast<int>(std::ceil(options_.ramp / options_.step)));
  const Time start = Clock::now();
  bool goes_on = wait_until(start);
  for (int step = 1; goes_on && step <= steps; ++step)
    goes_on = send_step(static_cast<double>(step) / steps) && wait_until(start + seconds(step * options_.ramp / steps));
  if (goes_on) goes_on = wait_until(Clock::now() + seconds(options_.hold));
  if (!goes_on) roll_back();
  return outcome_;
}

bool GainRamp::send_step(double share) {
  std::vector<GainValues> sent;
  for (const RampServer& one : servers_) sent.push_back(between(one.before, one.after, share));
  for (std::size_t k = 0; k < servers_.size(); ++k) send(k, sent[k]);
  return wait_for_answers() && confirm(sent);
}

void GainRamp::send(std::size_t server, const GainValues& values) {
  was_sent_[server] = true;
  const int request = answers_->expect(server);
  servers_[server].server->send(
      values, [answers = answers_, server, request](const GainServer::Answer& answer) { answers->put(server, request, answer); });
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

bool GainRamp::wait_for_answers() {
  const Time end = Clock::now() + seconds(options_.patience);
  while (!answers_->wait(kGlance)) {
    alarm_ = guard_();
    if (alarm_) return false;
    if (Clock::now() >= end) break;
  }
  return true;
}

bool GainRamp::confirm(const std::vector<GainValues>& sent) {
  for (std::size_t k = 0; k < servers_.size(); ++k) {
    const std::string& name = servers_[k].server->name();
    const GainServer::Answer answer = answers_->of(k);
    if (!answer)
      alarm_ = RampAlarm{answers_->is_there(k) ? name + " has refused the values or is gone"
                                               : name + " has not answered within " + to_decimal(options_.patience) + " s"};
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
    if (was_sent_[k]) {
      outcome_.now[k].reset();
      send(k, servers_[k].before);
    }
  if (std::none_of(was_sent_.begin(), was_sent_.end(), [](bool sent) { return sent; })) return;
  if (!answers_->wait(seconds(options_.grace))) {
    for (std::size_t k = 0; k < servers_.size(); ++k)
      if (was_sent_[k] && !answers_->is_there(k)) servers_[k].server->overtake();
    answers_->wait(seconds(options_.rollback_patience));
  }
  outcome_.rollback_seconds = std::chrono::duration<double>(Clock::now() - alarm_->since).count();
  for (std::size_t k = 0; k < servers_.size(); ++k) {
    const GainServer::Answer answer = was_sent_[k] ? answers_->of(k) : GainServer::Answer();
    if (answer && altered(servers_[k].before, *answer).empty()) outcome_.now[k] = servers_[k].before;
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
    if (found == answer.end()) return name + " = " + to_decimal(value.number) + " was sent, and it has no " + name;
    if (!(found->second == value))
      return name + " = " + to_decimal(value.number) + " was sent, and it has " + to_decimal(found->second.number);
  }
  return "";
}

}  // namespace codesign
