// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply/reconfigure_client.h"

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/service.h>

#include <chrono>
#include <utility>

namespace codesign {

GainValues values_of(const dynamic_reconfigure::Config& config) {
  GainValues values;
  for (const dynamic_reconfigure::DoubleParameter& one : config.doubles)
    values[one.name] = {one.value, false};
  for (const dynamic_reconfigure::BoolParameter& one : config.bools)
    values[one.name] = {one.value != 0 ? 1.0 : 0.0, true};
  return values;
}

dynamic_reconfigure::Config config_of(const GainValues& values) {
  dynamic_reconfigure::Config config;
  for (const auto& [name, value] : values) {
    if (value.is_flag) {
      config.bools.emplace_back();
      config.bools.back().name = name;
      config.bools.back().value = value.number != 0.0;
    } else {
      config.doubles.emplace_back();
      config.doubles.back().name = name;
      config.doubles.back().value = value.number;
    }
  }
  return config;
}

GainServerState state_of(const dynamic_reconfigure::ConfigDescription& description,
                         const dynamic_reconfigure::Config& now) {
  GainServerState state;
  const GainValues all = values_of(now), lower = values_of(description.min),
                   upper = values_of(description.max);
  for (const dynamic_reconfigure::Group& group : description.groups)
    for (const dynamic_reconfigure::ParamDescription& parameter : group.parameters) {
      const auto copy = [&parameter](const GainValues& from, GainValues* to) {
        if (const auto found = from.find(parameter.name); found != from.end()) to->insert(*found);
      };
      copy(all, &state.now);
      if (parameter.type != "double") continue;
      copy(lower, &state.lower);
      copy(upper, &state.upper);
    }
  return state;
}

ReconfigureClient::ReconfigureClient(ros::NodeHandle node, std::string name_space)
    : node_(std::move(node)), name_(std::move(name_space)) {
  descriptions_ = node_.subscribe<dynamic_reconfigure::ConfigDescription>(
      name_ + "/parameter_descriptions", 1,
      [this](const dynamic_reconfigure::ConfigDescription::ConstPtr& message) {
        const std::lock_guard<std::mutex> lock(mutex_);
        description_ = *message;
        changed_.notify_all();
      });
  updates_ = node_.subscribe<dynamic_reconfigure::Config>(
      name_ + "/parameter_updates", 1,
      [this](const dynamic_reconfigure::Config::ConstPtr& message) {
        const std::lock_guard<std::mutex> lock(mutex_);
        now_ = *message;
        changed_.notify_all();
      });
  thread_ = std::thread([this] { serve(); });
}

ReconfigureClient::~ReconfigureClient() {
  descriptions_.shutdown();
  updates_.shutdown();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
    changed_.notify_all();
    // Ends a call that waits for an answer.
    service_.shutdown();
  }
  thread_.join();
}

std::string ReconfigureClient::wait(double patience, const std::atomic<bool>& cancel) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
  const std::string service = name_ + "/set_parameters";
  std::string missing;
  do {
    if (cancel) return missing;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait_for(lock, std::chrono::milliseconds(50),
                        [this] { return description_ && now_; });
      missing = !description_ ? name_ + "/parameter_descriptions"
                : !now_       ? name_ + "/parameter_updates"
                              : "";
    }
    if (!missing.empty()) continue;
    if (ros::service::exists(service, false)) return "";
    missing = service;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  } while (std::chrono::steady_clock::now() < end);
  return missing;
}

GainServerState ReconfigureClient::state() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return state_of(*description_, *now_);
}

void ReconfigureClient::send(const GainValues& values, std::function<void(const Answer&)> answer) {
  const std::lock_guard<std::mutex> lock(mutex_);
  orders_.push_back({values, std::move(answer)});
  changed_.notify_all();
}

/// When its connection ends, a server of roscpp drops a request that it has not begun. It completes
/// a request that it has begun before the next one, because dynamic_reconfigure serves one request
/// at a time.
void ReconfigureClient::overtake() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_asking_ && !orders_.empty()) service_.shutdown();
}

void ReconfigureClient::serve() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ending_ || !orders_.empty(); });
    if (ending_) return;
    const Order order = std::move(orders_.front());
    orders_.pop_front();
    is_asking_ = true;
    lock.unlock();
    order.answer(ask(order.values));
    lock.lock();
    is_asking_ = false;
  }
}

/// Uses one connection, which is made again if the server was started again.
ReconfigureClient::Answer ReconfigureClient::ask(const GainValues& values) {
  ros::ServiceClient service;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!service_.isValid()) {
      lock.unlock();
      service =
          node_.serviceClient<dynamic_reconfigure::Reconfigure>(name_ + "/set_parameters", true);
      lock.lock();
      if (ending_) return {};
      service_ = service;
    }
    service = service_;
  }
  dynamic_reconfigure::Reconfigure exchange;
  exchange.request.config = config_of(values);
  if (!service || !service.call(exchange)) return {};
  return values_of(exchange.response.config);
}

}  // namespace codesign
