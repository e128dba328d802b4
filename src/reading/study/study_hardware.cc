// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "reading/study/entry_keys.h"
#include "reading/study/study_values.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr int kMostQueued = 100;

using ControllerKey = EntryKey<ControllerDescription>;

ControllerKey positive_key(const char* name, std::optional<Quantity> ControlRealization::*member) {
  return {name, false,
          [member](const YamlValue& value, const EntryContext& in, ControllerDescription* of) {
            of->realization.*member = read_quantity(value, in.table);
            if (!((of->realization.*member)->nominal() > 0.0))
              value.fail("this must be positive at the parameters' start", "more than 0");
          }};
}

/// A number: instants and steps that changed with a parameter would be kinks of the objective.
ControllerKey instant_key(const char* name, double ControlRealization::*member, bool may_be_zero) {
  return {name, false, [=](const YamlValue& value, const EntryContext&, ControllerDescription* of) {
            if (value.text().compare(0, 2, "${") == 0)
              value.fail("this must not depend on parameters", "a number");
            const double number = of->realization.*member = value.number();
            if (number < 0.0 || (number == 0.0 && !may_be_zero))
              value.fail(may_be_zero ? "this must not be negative" : "this must be positive",
                         may_be_zero ? "0 or more" : "more than 0");
          }};
}

/// A key that means nothing without another one.
void require_partner(const YamlValue& controller, const std::string& key, bool has_other,
                     const std::string& other) {
  if (const auto value = controller.find(key); value && !has_other)
    value->fail("this key needs " + other, "with " + other);
}

struct AntiWindupName {
  const char* name;
  AntiWindup method;
};
constexpr AntiWindupName kAntiWindups[] = {{"clamping", AntiWindup::kClamping},
                                           {"back_calculation", AntiWindup::kBackCalculation},
                                           {"conditional", AntiWindup::kConditional}};

/// The name of a method; or true, for clamping, or false.
AntiWindup read_antiwindup(const YamlValue& value) {
  const std::string text = value.text();
  for (const AntiWindupName& one : kAntiWindups)
    if (text == one.name) return one.method;
  try {
    return value.boolean() ? AntiWindup::kClamping : AntiWindup::kNone;
  } catch (const InputError&) {
    value.fail("unknown anti-windup",
               "false, clamping (the same as true), back_calculation, conditional");
  }
}

void read_rate_limit(const YamlValue& value, const EntryContext& in, ControllerDescription* of) {
  const bool is_sampled = of->realization.is_sampled();
  if (!is_sampled && !of->realization.time_constant)
    value.fail("the output of a continuous controller may jump, and has no rate to limit",
               "with sample_time; or with time_constant, the lag whose rate it bounds");
  of->realization.rate_limit = read_control_bounds(value, in.table, is_sampled);
}

void check_antiwindup(const YamlValue& value, const ControllerDescription& controller) {
  const ControlRealization& realization = controller.realization;
  if (realization.limit_has_corners) {
    require_partner(value, "antiwindup", !controller.i.is_zero(), "a gain i");
    require_partner(value, "antiwindup", realization.output_limit.has_value(), "output_limit");
  } else {
    require_partner(value, "antiwindup", realization.i_clamp.has_value(), "i_clamp");
  }
  const bool tracks = realization.antiwindup == AntiWindup::kBackCalculation;
  require_partner(value, "tracking_time", tracks, "antiwindup: back_calculation");
  if (tracks && !realization.tracking_time && controller.p.is_zero())
    value.at("antiwindup")
        .fail("without a gain p there is no default of tracking_time, which is p / i",
              "with tracking_time, or a gain p");
}

}  // namespace

ControlBounds read_control_bounds(const YamlValue& value, const ParameterTable& table,
                                  bool may_be_zero) {
  if (!value.is_list()) {
    const Quantity bound = read_quantity(value, table);
    if (!(bound.nominal() > 0.0))
      value.fail("this must be positive at the parameters' start",
                 "more than 0; or [lower, upper]");
    return {bound, std::nullopt};
  }
  const std::vector<YamlValue> items = value.items();
  if (items.size() != 2)
    value.fail("two bounds are needed, found " + std::to_string(items.size()), "[lower, upper]");
  ControlBounds bounds{read_quantity(items[1], table), read_quantity(items[0], table)};
  const double lower = bounds.lower->nominal();
  const auto is_bad = [may_be_zero](double x) { return may_be_zero ? x < 0.0 : !(x > 0.0); };
  if (is_bad(-lower))
    items[0].fail("the lower bound must be negative at the parameters' start",
                  may_be_zero ? "0 or less" : "less than 0; 0, too, where the bound has corners");
  if (is_bad(bounds.upper.nominal()))
    items[1].fail("the upper bound must be positive at the parameters' start",
                  may_be_zero ? "0 or more" : "more than 0; 0, too, where the bound has corners");
  if (!(lower < bounds.upper.nominal()))
    value.fail("the bounds leave nothing between them", "[lower, upper] with lower below upper");
  return bounds;
}

ControllerKeys realization_keys(ControllerKind kind) {
  using Of = ControllerDescription;
  using R = ControlRealization;
  const EntryKeys<Of> of_pid{
      positive_key("derivative_filter", &R::derivative_filter),
      positive_key("tracking_time", &R::tracking_time),
      instant_key("quantization", &R::quantization, true),
      {"antiwindup", false,
       [](const YamlValue& value, const EntryContext&, Of* of) {
         of->realization.antiwindup = read_antiwindup(value);
         of->realization.limit_has_corners =
             of->realization.antiwindup == AntiWindup::kBackCalculation ||
             of->realization.antiwindup == AntiWindup::kConditional;
       }},
      {"derivative", false,
       [](const YamlValue& value, const EntryContext&, Of* of) {
         of->realization.rates_input =
             value.choice("quantity", {"error", "measurement"}) == "measurement";
       }},
      {"i_clamp", false, [](const YamlValue& value, const EntryContext& in, Of* of) {
         of->realization.i_clamp =
             read_control_bounds(value, in.table, of->realization.is_sampled());
       }}};
  const EntryKeys<Of> of_errors{
      {"filter", false, [](const YamlValue& value, const EntryContext& in, Of* of) {
         of->filters = read_filters(value, in.table);
       }}};
  if (kind->input == ControlInput::kObserved)
    return {instant_key("sample_time", &R::sample_time, false)};
  // The bounds come last: whether they may be zero depends on the sampling and the anti-windup.
  EntryKeys<Of> keys{positive_key("time_constant", &R::time_constant),
                     instant_key("sample_time", &R::sample_time, false),
                     instant_key("delay", &R::delay, true)};
  if (kind->has_error()) keys = with(keys, of_errors);
  if (kind->is_pid) keys = with(keys, of_pid);
  keys.push_back(
      {"output_limit", false, [](const YamlValue& value, const EntryContext& in, Of* of) {
         of->realization.output_limit = read_control_bounds(
             value, in.table, of->realization.is_sampled() || of->realization.limit_has_corners);
       }});
  keys.push_back({"rate_limit", false, read_rate_limit});
  return keys;
}

void check_realization(const YamlValue& value, const ControllerDescription& controller) {
  const ControlRealization& realization = controller.realization;
  require_partner(value, "i_clamp", !controller.i.is_zero(), "a gain i");
  check_antiwindup(value, controller);
  require_partner(value, "derivative", !controller.d.is_zero(), "a gain d");
  require_partner(value, "derivative_filter", !controller.d.is_zero(), "a gain d");
  require_partner(value, "delay", realization.is_sampled(), "sample_time");
  require_partner(value, "quantization", realization.is_sampled(), "sample_time");
  require_partner(value, "time_constant", !controller.output.empty(),
                  "output, the joint that the controller drives");
  if (realization.queued() > kMostQueued)
    value.at("delay").fail(
        "too many outputs wait at a time: " +
            readable(std::ceil(realization.delay / realization.sample_time - 1e-9)),
        "at most " + std::to_string(kMostQueued) + " times sample_time, which is " +
            readable(kMostQueued * realization.sample_time) + " s");
}

namespace {

/// @throws InputError, located at `at`, if no controller has this name.
const ControllerDescription& find_controller(const std::string& name, const YamlValue& at,
                                             const Study& study) {
  std::vector<std::string> names;
  std::string all;
  for (const ControllerDescription& controller : study.controllers) {
    if (controller.name == name) return controller;
    names.push_back(controller.name);
    all += (all.empty() ? "" : ", ") + controller.name;
  }
  at.fail("no controller of the study has this name" + did_you_mean(nearest_name(name, names)),
          all.empty() ? "no controller" : all);
}

/// The law on the robot is control_toolbox's; others have gains of another kind.
void require_pid_gains(const ControllerDescription& controller, const YamlValue& at) {
  if (!controller.kind->is_pid && controller.kind->load != ControlLoad::kAtRest)
    at.fail("this controller has no p, i and d that act on an effort",
            "controllers of type pid or pd_gravity");
}

/// A name of ROS, in each part between slashes.
bool is_part(const std::string& part) {
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !part.empty() && std::isalpha(static_cast<unsigned char>(part[0])) != 0 &&
         std::all_of(part.begin(), part.end(), is_plain);
}

std::string read_namespace(const YamlValue& value) {
  std::string text = value.text();
  if (text.front() == '/') text.erase(0, 1);
  if (!text.empty() && text.back() == '/') text.pop_back();
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t slash = std::min(text.find('/', first), text.size());
    if (!is_part(text.substr(first, slash - first)))
      value.fail("not a namespace of ROS parameters",
                 "parts of letters, digits and _, joined by /, such as arm_controller/gains/elbow");
    first = slash + 1;
  }
  return text;
}

/// Neither may lie within the other: `p` of one would be a namespace of the other, or the same
/// parameter.
bool overlap(const std::string& a, const std::string& b) {
  return (a + "/").rfind(b + "/", 0) == 0 || (b + "/").rfind(a + "/", 0) == 0;
}

/// control_toolbox takes an absent i_clamp for zero, which would switch the integral off.
void require_clamp(const ControllerDescription& controller, const HardwareGains& gains,
                   const YamlValue& value) {
  if (!controller.i.is_zero() && !gains.i_clamp)
    value.fail(
        "the controller has an i gain, and control_toolbox limits the integral's effort to zero "
        "unless i_clamp says more",
        "i_clamp: the largest effort of the integral term [N m or N]");
}

/// A controller with a clamp of its own takes no further one: the robot gets this clamp, since it
/// was simulated.
void require_no_clamp(const ControllerDescription& controller, const YamlValue& value) {
  if (controller.realization.i_clamp)
    value.fail("the controller of the study has i_clamp already, which the robot gets",
               "no such key here");
}

/// What the gains of a controller are read with.
struct GainsContext {
  const ControllerDescription& controller;
  const ParameterTable& table;
};
using GainsKeys = EntryKeys<HardwareGains, GainsContext>;

void read_gains_clamp(const YamlValue& value, const GainsContext& in, HardwareGains* gains) {
  require_no_clamp(in.controller, value);
  if (value.is_list()) {
    gains->i_clamp = read_control_bounds(value, in.table, true);
    return;
  }
  const Quantity bound = read_quantity(value, in.table);
  if (bound.nominal() < 0.0) value.fail("the clamp must not be negative", "0 or more");
  gains->i_clamp = ControlBounds{bound, std::nullopt};
}

const GainsKeys& gains_keys() {
  static const GainsKeys kKeys{
      {"namespace", true,
       [](const YamlValue& value, const GainsContext&, HardwareGains* of) {
         of->name_space = read_namespace(value);
       }},
      {"i_clamp", false, read_gains_clamp},
      {"antiwindup", false, [](const YamlValue& value, const GainsContext& in, HardwareGains* of) {
         require_no_clamp(in.controller, value);
         of->antiwindup = value.boolean();
       }}};
  return kKeys;
}

HardwareGains read_gains_of(const std::string& name, const YamlValue& value,
                            const ParameterTable& table, const Study& study) {
  require_keys(value, gains_keys());
  const ControllerDescription& controller = find_controller(name, value, study);
  require_pid_gains(controller, value);
  HardwareGains gains;
  gains.controller = name;
  gains.where = value.where();
  if (controller.realization.i_clamp) {
    gains.i_clamp = controller.realization.i_clamp;
    gains.antiwindup = controller.realization.antiwindup == AntiWindup::kClamping;
  }
  read_entry(value, gains_keys(), GainsContext{controller, table}, &gains);
  require_clamp(controller, gains, value);
  return gains;
}

}  // namespace

std::vector<EntryForm> forms_of_hardware() { return {{"hardware.CONTROLLER", gains_keys()}}; }

void read_hardware(const YamlValue& root, const ParameterTable& table, Study* study) {
  const auto hardware = root.find("hardware");
  if (!hardware) return;
  for (const auto& [name, value] : hardware->entries()) {
    HardwareGains gains = read_gains_of(name, value, table, *study);
    for (const HardwareGains& other : study->hardware)
      if (overlap(other.name_space, gains.name_space))
        value.at("namespace")
            .fail("the gains of \"" + other.controller + "\" are there, too",
                  "a namespace of its own");
    study->hardware.push_back(std::move(gains));
  }
}

}  // namespace codesign
