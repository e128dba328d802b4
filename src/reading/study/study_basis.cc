// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <unordered_set>

#include "description/expression.h"
#include "math/arrays.h"
#include "reading/study/study_values.h"

namespace codesign {
namespace {

std::string coefficient_name(const std::string& controller, std::size_t k) {
  return controller + "_c" + std::to_string(k);
}

std::size_t read_count(const YamlValue& coefficients) {
  constexpr int kMost = 10000;
  const YamlValue count = coefficients.at("count");
  if (count.integer() < 2 || count.integer() > kMost)
    count.fail("number of coefficients out of range", "2 to " + std::to_string(kMost));
  return to_index(count.integer());
}

/// The start of each coefficient: `initial` is one number for all or a list with one for each; 0 if
/// it is missing.
std::vector<double> read_starts(const YamlValue& coefficients, std::size_t count) {
  const auto initial = coefficients.find("initial");
  if (!initial) return std::vector<double>(count, 0.0);
  if (!initial->is_list()) return std::vector<double>(count, initial->number());
  std::vector<double> starts;
  for (const YamlValue& item : initial->items()) starts.push_back(item.number());
  if (starts.size() != count)
    initial->fail("found " + std::to_string(starts.size()) + " values for " +
                      std::to_string(count) + " coefficients",
                  "one per coefficient");
  return starts;
}

}  // namespace

void declare_numbers(const YamlValue& coefficients, const std::string& prefix,
                     const std::vector<double>& starts, Study* study) {
  const std::size_t count = starts.size();
  const auto tune = coefficients.find("tune");
  std::unordered_set<std::string> taken;
  for (const Parameter& parameter : study->parameters) taken.insert(parameter.name);
  for (std::size_t k = 0; k < count; ++k) {
    Parameter parameter;
    parameter.name = prefix + std::to_string(k);
    parameter.value = starts[k];
    parameter.where = coefficients.where();
    const std::string fault = identifier_fault(parameter.name);
    if (!fault.empty())
      coefficients.fail("the controller's name cannot be part of a parameter's name: " + fault,
                        "a name that is an identifier");
    if (!taken.insert(parameter.name).second)
      coefficients.fail("there is a parameter \"" + parameter.name + "\" already",
                        "another name for the controller");
    read_bounds(coefficients, &parameter);
    if (!tune || tune->boolean())
      study->tuned.push_back(static_cast<int>(study->parameters.size()));
    study->parameters.push_back(parameter);
  }
}

namespace {

void declare(const std::string& controller, const YamlValue& coefficients, Study* study) {
  coefficients.require_keys({"count"}, {"initial", "lower", "upper", "tune"});
  const std::vector<double> starts = read_starts(coefficients, read_count(coefficients));
  declare_numbers(coefficients, controller + "_c", starts, study);
}

bool asks_for_parameters(const YamlValue& controller) {
  if (!controller.is_map()) return false;
  const auto type = controller.find("type"), coefficients = controller.find("coefficients");
  return type && type->is_scalar() && type->text() == "basis" && coefficients &&
         coefficients->is_map();
}

}  // namespace

void declare_coefficients(const YamlValue& study_value, Study* study) {
  const auto controllers = study_value.find("controllers");
  if (!controllers) return;
  for (const auto& [name, value] : controllers->entries())
    if (asks_for_parameters(value)) declare(name, value.at("coefficients"), study);
}

BasisDescription read_basis(const std::string& controller, const YamlValue& value,
                            const ParameterTable& table, double study_duration) {
  BasisDescription basis;
  const auto shape = value.find("shape");
  if (shape && shape->choice("shape", {"linear", "cubic"}) == "cubic")
    basis.shape = BasisShape::kCubic;
  const auto duration = value.find("duration");
  basis.duration = duration ? duration->number() : study_duration;
  if (duration && !(basis.duration > 0.0))
    duration->fail("the duration must be positive", "more than 0 s");
  const YamlValue coefficients = value.at("coefficients");
  if (coefficients.is_map()) {
    for (std::size_t k = 0; k < read_count(coefficients); ++k) {
      const std::string name = coefficient_name(controller, k);
      basis.coefficients.emplace_back(table.values[to_index(table.index.at(name))],
                                      table.parse(name));
    }
  } else {
    for (const YamlValue& item : coefficients.items())
      basis.coefficients.push_back(read_quantity(item, table));
  }
  if (basis.count() <= basis.degree())
    coefficients.fail("found " + std::to_string(basis.count()) + " coefficients",
                      "at least 2 for linear, 4 for cubic");
  return basis;
}

}  // namespace codesign
