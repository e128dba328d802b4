// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_constraints.h"

#include "description/tuned_parameters.h"
#include "reading/study/study_between.h"
#include "reading/study/study_values.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kFormsOfConstraints =
    "\"expression >= expression\", {expression: \"${expression}\", between: [lower, upper]} or {peak: signal, at_most: bound}";

std::string text_of(const Quantity& quantity) {
  return quantity.is_constant() ? to_decimal(quantity.nominal()) : quantity.expression()->text();
}

/// @param table the study's parameters. It is a copy, not the table in the study, since reading a constraint must not mark its parameters
/// as used: a constraint moves nothing.
void read_bounded_expression(const YamlValue& item, const ParameterTable& table, Study* study) {
  item.require_keys({"expression"}, {"between", "at_least", "at_most"});
  const YamlValue at = item.at("expression");
  const Quantity expression = read_quantity(at, table);
  if (expression.is_constant() || expression.expression()->dependencies().empty())
    at.fail("no parameter appears in the constraint", "an \"${expression}\" of the parameters");
  const Between bounds = read_between(item, table);
  if (bounds.lower && bounds.upper && !(bounds.lower->nominal() < bounds.upper->nominal()))
    item.fail("the lower bound, " + to_decimal(bounds.lower->nominal()) + ", must be less than the upper one, " +
                  to_decimal(bounds.upper->nominal()) + ", at the parameters' start",
              "lower < upper; a parameter that follows from others is no parameter, but an expression where it is used");
  const auto add = [&](const std::string& text, const std::string& less, const std::string& more) {
    study->constraints.push_back(make_constraint(text, less, more, table.names, item.where(), item.path()));
  };
  const std::string middle = expression.expression()->text();
  if (bounds.lower) add(middle + " >= " + text_of(*bounds.lower), text_of(*bounds.lower), middle);
  if (bounds.upper) add(middle + " <= " + text_of(*bounds.upper), middle, text_of(*bounds.upper));
}

}  // namespace

bool bounds_a_peak(const YamlValue& item) { return item.is_map() && item.find("peak"); }

void read_constraints(const YamlValue& study_value, Study* study) {
  const auto constraints = study_value.find("constraints");
  if (!constraints) return;
  const ParameterTable table(study->parameters);
  for (const YamlValue& item : constraints->items()) {
    if (bounds_a_peak(item)) continue;
    if (item.is_list() || (item.is_map() && !item.find("expression"))) item.fail("not a constraint", kFormsOfConstraints);
    if (item.is_map())
      read_bounded_expression(item, table, study);
    else
      study->constraints.push_back(parse_constraint(item.text(), table.names, item.where(), item.path()));
  }
}

}  // namespace codesign
