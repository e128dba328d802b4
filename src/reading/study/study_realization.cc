// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_realization.h"

#include <algorithm>
#include <cmath>

#include "reading/study/study_values.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr int kMostQueued = 100;

std::optional<Quantity> read_positive_quantity(const YamlValue& controller, const std::string& key, const ParameterTable& table) {
  const auto value = controller.find(key);
  if (!value) return std::nullopt;
  const Quantity quantity = read_quantity(*value, table);
  if (!(quantity.nominal() > 0.0)) value->fail("this must be positive at the parameters' start", "more than 0");
  return quantity;
}

/// A number: instants and steps that changed with a parameter would be kinks of the objective.
double read_instant(const YamlValue& controller, const std::string& key, bool may_be_zero) {
  const auto value = controller.find(key);
  if (!value) return 0.0;
  if (value->text().compare(0, 2, "${") == 0) value->fail("this must not depend on parameters", "a number");
  const double number = value->number();
  if (number < 0.0 || (number == 0.0 && !may_be_zero))
    value->fail(may_be_zero ? "this must not be negative" : "this must be positive", may_be_zero ? "0 or more" : "more than 0");
  return number;
}

/// A key that means nothing without another one.
void require_partner(const YamlValue& controller, const std::string& key, bool has_other, const std::string& other) {
  if (const auto value = controller.find(key); value && !has_other) value->fail("this key needs " + other, "with " + other);
}

}  // namespace

std::vector<std::string> with_realization_keys(ControllerKind kind, std::vector<std::string> own) {
  own.insert(own.end(), {"output_limit", "sample_time", "delay", "time_constant"});
  if (kind->is_pid) own.insert(own.end(), {"i_clamp", "antiwindup", "derivative_filter", "quantization"});
  return own;
}

void read_realization(const YamlValue& value, const ParameterTable& table, ControllerDescription* controller) {
  ControlRealization& realization = controller->realization;
  realization.i_clamp = read_positive_quantity(value, "i_clamp", table);
  realization.derivative_filter = read_positive_quantity(value, "derivative_filter", table);
  realization.output_limit = read_positive_quantity(value, "output_limit", table);
  realization.time_constant = read_positive_quantity(value, "time_constant", table);
  if (const auto antiwindup = value.find("antiwindup")) realization.antiwindup = antiwindup->boolean();
  realization.sample_time = read_instant(value, "sample_time", false);
  realization.delay = read_instant(value, "delay", true);
  realization.quantization = read_instant(value, "quantization", true);
  require_partner(value, "i_clamp", !controller->i.is_zero(), "a gain i");
  require_partner(value, "antiwindup", realization.i_clamp.has_value(), "i_clamp");
  require_partner(value, "derivative_filter", !controller->d.is_zero(), "a gain d");
  require_partner(value, "delay", realization.is_sampled(), "sample_time");
  require_partner(value, "quantization", realization.is_sampled(), "sample_time");
  require_partner(value, "time_constant", !controller->output.empty(), "output, the joint that the controller drives");
  if (realization.queued() > kMostQueued)
    value.at("delay").fail("too many outputs wait at a time: " + readable(std::ceil(realization.delay / realization.sample_time - 1e-9)),
                           "at most " + std::to_string(kMostQueued) + " times sample_time, which is " +
                               readable(kMostQueued * realization.sample_time) + " s");
}

void refuse_adjoint_of_sampled(const YamlValue& study_value, const Study& study) {
  const auto sampled = [](const ControllerDescription& controller) { return controller.realization.is_sampled(); };
  if (study.solver.gradient != GradientMethod::kAdjoint || std::none_of(study.controllers.begin(), study.controllers.end(), sampled))
    return;
  study_value.at("solver")
      .at("gradient")
      .fail("the adjoint does not go back over the samples of controllers with sample_time", "auto, direct");
}

}  // namespace codesign
