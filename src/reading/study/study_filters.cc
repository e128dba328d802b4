// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "forces/pade.h"
#include "reading/study/study_blocks.h"
#include "reading/study/study_values.h"
#include "text/number_text.h"

namespace codesign {
namespace {

Quantity read_filter_number(const YamlValue& filter, const FilterNumber& of,
                            const ParameterTable& table) {
  const auto value = filter.find(of.name);
  if (!value) return of.standard;
  Quantity quantity = read_quantity(*value, table);
  const double number = quantity.nominal();
  if (of.may_be_zero ? !(number >= 0.0) : !(number > 0.0))
    value->fail(of.may_be_zero ? "this must not be negative at the parameters' start"
                               : "this must be positive at the parameters' start",
                of.may_be_zero ? "0 or more" : "more than 0");
  return quantity;
}

/// The sections of Pade's approximation of a delay.
std::vector<FilterDescription> read_pade(const YamlValue& value, const ParameterTable& table) {
  value.require_keys({"type", "delay", "order"}, {});
  const YamlValue order = value.at("order");
  const std::string allowed = "1 to " + std::to_string(kMostPade);
  if (order.integer() < 1 || order.integer() > kMostPade)
    order.fail("no order of Pade's approximation", allowed);
  const Quantity delay = read_filter_number(value, FilterNumber{"delay"}, table);
  std::vector<FilterDescription> sections;
  for (const PadeSection& section : pade_sections(order.integer()))
    sections.push_back(
        {section.kind, {delay, Quantity(section.size), Quantity(section.damping)}, value.where()});
  return sections;
}

std::vector<FilterDescription> read_filter(const YamlValue& value, const ParameterTable& table) {
  const std::vector<FilterKind> laws = filter_laws();
  std::vector<std::string> names = names_of(laws);
  names.emplace_back("pade");
  const std::string type = value.at("type").choice("filter", names);
  if (type == "pade") return read_pade(value, table);
  FilterDescription filter;
  filter.where = value.where();
  filter.kind = *std::find_if(laws.begin(), laws.end(),
                              [&type](const FilterKind& law) { return law->name == type; });
  std::vector<std::string> required{"type"}, optional;
  for (std::size_t k = 0; k < filter.kind->count(); ++k) {
    const FilterNumber& number = filter.kind->numbers[k];
    (std::isnan(number.standard) ? required : optional).emplace_back(number.name);
  }
  value.require_keys(required, optional);
  for (std::size_t k = 0; k < filter.kind->count(); ++k)
    filter.numbers.push_back(read_filter_number(value, filter.kind->numbers[k], table));
  return {filter};
}

void refuse_sampled_pade(const FilterDescription& filter, const std::string& element) {
  if (is_pade(filter.kind))
    throw InputError({filter.where, element,
                      "Pade's approximation is one of continuous controllers; the delay of a "
                      "sampled one is exact",
                      "pade", "the controller's delay"});
}

void refuse_beyond_half_rate(const FilterDescription& filter, const std::string& element,
                             double sample_time) {
  if (sample_time > 0.0) refuse_sampled_pade(filter, element);
  const double frequency = filter.numbers.front().nominal();
  if (!filter.kind->is_prewarped || !(frequency * sample_time >= 0.5)) return;
  throw InputError({filter.where, element,
                    "a sampled filter cannot have its frequency at half of the sampling rate or "
                    "beyond",
                    readable(frequency) + " Hz", "below " + readable(0.5 / sample_time) + " Hz"});
}

}  // namespace

void check_filters(const ControllerDescription& controller) {
  const double sample_time = controller.realization.sample_time;
  const std::string element = "controllers." + controller.name;
  for (const FilterDescription& filter : controller.filters)
    refuse_beyond_half_rate(filter, element + ".filter", sample_time);
  for (std::size_t k = 0; k < controller.feedback.size(); ++k)
    for (const FilterDescription& filter : controller.feedback[k].filters)
      refuse_beyond_half_rate(filter, element + ".feedback[" + std::to_string(k) + "].filter",
                              sample_time);
}

std::vector<FilterDescription> read_filters(const YamlValue& value, const ParameterTable& table) {
  std::vector<FilterDescription> filters;
  if (!value.is_list()) return read_filter(value, table);
  for (const YamlValue& item : value.items())
    for (FilterDescription& filter : read_filter(item, table)) filters.push_back(std::move(filter));
  if (filters.empty()) value.fail("the list is empty", "at least one filter");
  return filters;
}

}  // namespace codesign
