// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply/apply.h"

#include <algorithm>

#include "reading/study/study_values.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

std::vector<std::string> names_of(const GainValues& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "no numbers and truth values" : text;
}

/// Fits an order to the parameters that one server has.
class Fitting {
 public:
  Fitting(const GainServerState& state, const std::string& name) : state_(state), name_(name) {}

  bool has(const std::string& parameter) const { return state_.now.count(parameter) > 0; }

  void set(const std::string& parameter, const GainValue& value) {
    const auto found = state_.now.find(parameter);
    if (found == state_.now.end())
      throw InputError({{name_, 0},
                        parameter,
                        "the server has no such parameter" +
                            did_you_mean(nearest_name(parameter, names_of(state_.now))),
                        to_decimal(value.number),
                        listed(names_of(state_.now))});
    if (found->second.is_flag != value.is_flag)
      throw InputError({{name_, 0},
                        parameter,
                        "the server has a parameter of another type",
                        found->second.is_flag ? "bool" : "double",
                        value.is_flag ? "bool" : "double"});
    if (!value.is_flag) require_within(parameter, value.number);
    wanted_[parameter] = value;
  }

  void set_clamp(const RobotGains& gains) {
    if (has("i_clamp_max")) {
      set("i_clamp_max", {gains.i_clamp_max, false});
      if (has("i_clamp_min") || gains.i_clamp_min != -gains.i_clamp_max)
        set("i_clamp_min", {gains.i_clamp_min, false});
    } else if (gains.i_clamp_min != -gains.i_clamp_max) {
      set("i_clamp_max", {gains.i_clamp_max, false});
    } else if (has("i_clamp") || gains.i != 0.0) {
      set("i_clamp", {gains.i_clamp_max, false});
    }
  }

  GainValues take() { return std::move(wanted_); }

 private:
  void require_within(const std::string& parameter, double value) const {
    const auto lower = state_.lower.find(parameter), upper = state_.upper.find(parameter);
    const bool low = lower != state_.lower.end() && !(value >= lower->second.number);
    const bool high = upper != state_.upper.end() && !(value <= upper->second.number);
    if (!low && !high) return;
    const auto bound = [](bool known, const auto& found, const char* none) {
      return known ? to_decimal(found->second.number) : none;
    };
    throw InputError({{name_, 0},
                      parameter,
                      "the value is outside the limits of the server",
                      to_decimal(value),
                      bound(lower != state_.lower.end(), lower, "-inf") + " to " +
                          bound(upper != state_.upper.end(), upper, "inf")});
  }

  const GainServerState& state_;
  const std::string& name_;
  GainValues wanted_;
};

void require_bounds(const FinishedJob& job) {
  const std::vector<Parameter>& all = job.problem.all_parameters();
  for (std::size_t k = 0; k < all.size(); ++k)
    require_within_bounds(job.parameters[k], all[k], {job.folder, 0}, all[k].name);
}

}  // namespace

std::vector<GainOrder> orders_of(const FinishedJob& job, const std::string& server) {
  require_bounds(job);
  std::vector<GainOrder> orders;
  if (!server.empty()) {
    GainOrder order{server, std::nullopt, {}};
    const std::vector<Parameter>& all = job.problem.all_parameters();
    for (std::size_t k = 0; k < all.size(); ++k)
      if (std::count(job.tuned.begin(), job.tuned.end(), all[k].name) > 0)
        order.parameters[all[k].name] = {job.parameters[k], false};
    orders.push_back(std::move(order));
    return orders;
  }
  for (RobotGains& gains : robot_gains(job.problem, job.parameters)) {
    const std::string name_space = gains.name_space;
    orders.push_back({name_space, std::move(gains), {}});
  }
  if (orders.empty())
    throw InputError({{job.problem.study_text().name, 0},
                      "hardware",
                      "the study does not say where the robot keeps its gains",
                      "",
                      "an entry for each controller, or the namespace of a server that has the "
                      "study's parameters (--server)"});
  return orders;
}

GainValues wanted_values(const GainOrder& order, const GainServerState& state,
                         const std::string& name) {
  Fitting fitting(state, name);
  for (const auto& [parameter, value] : order.parameters) fitting.set(parameter, value);
  if (order.gains) {
    fitting.set("p", {order.gains->p, false});
    fitting.set("i", {order.gains->i, false});
    fitting.set("d", {order.gains->d, false});
    fitting.set_clamp(*order.gains);
    if (order.gains->antiwindup || fitting.has("antiwindup"))
      fitting.set("antiwindup", {order.gains->antiwindup ? 1.0 : 0.0, true});
  }
  return fitting.take();
}

GainValues only(const GainValues& names, const GainValues& values) {
  GainValues found;
  for (const auto& [name, value] : names) found[name] = values.at(name);
  return found;
}

}  // namespace codesign
