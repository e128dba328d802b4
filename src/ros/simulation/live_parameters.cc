// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/live_parameters.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/arrays.h"
#include "ros/common/latched.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kGroup = "Default";

dynamic_reconfigure::Config config_by(const std::vector<Parameter>& parameters,
                                      const std::function<double(std::size_t)>& number) {
  dynamic_reconfigure::Config config;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    dynamic_reconfigure::DoubleParameter& entry = config.doubles.emplace_back();
    entry.name = parameters[k].name;
    entry.value = number(k);
  }
  dynamic_reconfigure::GroupState& group = config.groups.emplace_back();
  group.name = kGroup;
  group.state = 1;
  return config;
}

/// @param number nullopt: the request has a text or a truth value.
void want(const std::vector<Parameter>& parameters, const std::string& name,
          std::optional<double> number, const std::string& text, WantedParameters* wanted) {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const Parameter& each) { return each.name == name; });
  if (found == parameters.end()) {
    std::vector<std::string> known;
    known.reserve(parameters.size());
    for (const Parameter& each : parameters) known.push_back(each.name);
    wanted->warnings.push_back(
        {"parameter_refused",
         unknown_name({"set_parameters", 0}, name, "parameter", name, known).what(),
         {}});
    return;
  }
  if (!number || !std::isfinite(*number)) {
    wanted->warnings.push_back(
        {"parameter_refused",
         InputError({{"set_parameters", 0}, name, "not a finite number", text, "a finite number"})
             .what(),
         {}});
    return;
  }
  double& value = wanted->values[to_index(found - parameters.begin())];
  value = std::clamp(*number, found->lower, found->upper);
  if (value != *number)
    wanted->warnings.push_back({"parameter_bounded",
                                "set_parameters: " + name + " = " + text +
                                    " is out of bounds and became " + to_decimal(value),
                                {}});
}

}  // namespace

dynamic_reconfigure::ConfigDescription describe_parameters(
    const std::vector<Parameter>& parameters) {
  dynamic_reconfigure::ConfigDescription description;
  dynamic_reconfigure::Group& group = description.groups.emplace_back();
  group.name = kGroup;
  for (const Parameter& parameter : parameters) {
    dynamic_reconfigure::ParamDescription& entry = group.parameters.emplace_back();
    entry.name = parameter.name;
    entry.type = "double";
    entry.description =
        parameter.unit.empty() ? parameter.name : parameter.name + " [" + parameter.unit + "]";
  }
  description.min = config_by(parameters, [&](std::size_t k) { return parameters[k].lower; });
  description.max = config_by(parameters, [&](std::size_t k) { return parameters[k].upper; });
  description.dflt = config_by(parameters, [&](std::size_t k) { return parameters[k].value; });
  return description;
}

dynamic_reconfigure::Config config_of(const std::vector<Parameter>& parameters,
                                      const std::vector<double>& values) {
  return config_by(parameters, [&](std::size_t k) { return values[k]; });
}

WantedParameters wanted_parameters(const std::vector<Parameter>& parameters,
                                   const std::vector<double>& values,
                                   const dynamic_reconfigure::Config& request) {
  WantedParameters wanted{values, {}};
  for (const dynamic_reconfigure::DoubleParameter& entry : request.doubles)
    want(parameters, entry.name, entry.value, to_decimal(entry.value), &wanted);
  for (const dynamic_reconfigure::IntParameter& entry : request.ints)
    want(parameters, entry.name, entry.value, std::to_string(entry.value), &wanted);
  for (const dynamic_reconfigure::StrParameter& entry : request.strs)
    want(parameters, entry.name, std::nullopt, entry.value, &wanted);
  for (const dynamic_reconfigure::BoolParameter& entry : request.bools)
    want(parameters, entry.name, std::nullopt, entry.value != 0 ? "true" : "false", &wanted);
  return wanted;
}

LiveParameters::LiveParameters(ros::NodeHandle node, const std::vector<Parameter>& parameters,
                               const std::vector<double>& values, NodeState* state, Bell* bell)
    : parameters_(parameters), state_(state), bell_(bell), values_(values) {
  descriptions_ =
      node.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true);
  publish_latched(descriptions_, describe_parameters(parameters_));
  updates_ = node.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true);
  publish_latched(updates_, config_of(parameters_, values_));
  const boost::function<bool(dynamic_reconfigure::ReconfigureRequest&,
                             dynamic_reconfigure::ReconfigureResponse&)>
      callback = [this](dynamic_reconfigure::ReconfigureRequest& request,
                        dynamic_reconfigure::ReconfigureResponse& response) {
        response.config = set(request.config);
        return true;
      };
  server_ = node.advertiseService("set_parameters", callback);
}

dynamic_reconfigure::Config LiveParameters::set(const dynamic_reconfigure::Config& request) {
  const std::lock_guard<std::mutex> turn(requests_);
  std::unique_lock<std::mutex> lock(mutex_);
  WantedParameters wanted = wanted_parameters(parameters_, values_, request);
  if (wanted.values != values_ && !stopped_) {
    wanted_ = wanted.values;
    bell_->ring();
    answered_.wait(lock, [this] { return !wanted_ || stopped_; });
    if (!status_.ok())
      wanted.warnings.push_back({"parameter_refused",
                                 "set_parameters: the values were refused, " +
                                     std::string(name_of(status_.code)) + ": " + reason(status_),
                                 {}});
  }
  state_->warn("live parameters", wanted.warnings);
  return config_of(parameters_, values_);
}

// The request stays until it is answered, so that no second request replaces it.
bool LiveParameters::serve(const std::function<Status(const std::vector<double>&)>& change) {
  std::vector<double> wanted;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!wanted_) return false;
    wanted = *wanted_;
  }
  const Status status = change(wanted);
  const std::lock_guard<std::mutex> lock(mutex_);
  status_ = status;
  if (status.ok()) {
    values_ = wanted;
    publish_latched(updates_, config_of(parameters_, values_));
  }
  wanted_.reset();
  answered_.notify_all();
  return status.ok();
}

void LiveParameters::stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  stopped_ = true;
  answered_.notify_all();
}

}  // namespace codesign
