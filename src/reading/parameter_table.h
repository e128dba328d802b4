// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "description/expression.h"
#include "description/parameter_switches.h"
#include "math/arrays.h"
#include "mechanism_codesign/parameter.h"

namespace codesign {

/// The parameters that the expressions of one file may use, with their default values. Every
/// expression of model and study is parsed here, so that the table knows which parameters are used.
/// Not thread-safe.
struct ParameterTable {
  ParameterTable() = default;
  explicit ParameterTable(const std::vector<Parameter>& parameters) {
    for (const Parameter& parameter : parameters) {
      index.emplace(parameter.name, static_cast<int>(names.size()));
      names.push_back(parameter.name);
      values.push_back(parameter.value);
    }
  }

  /// The expression that stands inside `${...}`; from now on its parameters are used. @throws
  /// std::invalid_argument as Expression.
  std::shared_ptr<const Expression> parse(const std::string& text) const {
    return parse(text, {index_of(), [this] { return names; }});
  }
  /// The same, where the name t is the time unless a parameter has this name; its index is
  /// time_index().
  std::shared_ptr<const Expression> parse_with_time(const std::string& text) const {
    const auto find = [this, parameter = index_of()](const std::string& name) {
      const int found = parameter(name);
      return found < 0 && name == "t" ? time_index() : found;
    };
    return parse(text, {find, [this] { return names; }});
  }
  /// The switches of an expression that parse() or parse_with_time() has returned. @param times at
  /// which it is looked at [s].
  std::vector<ParameterSwitch> switches_of(const std::shared_ptr<const Expression>& expression,
                                           const std::vector<double>& times,
                                           bool at_instant = false) const {
    const auto variable = [&](int k) -> ExpressionVariable {
      const int parameter = expression->dependencies()[to_index(k)];
      if (parameter == time_index()) return {VariableKind::kTime, -1};
      return {VariableKind::kParameter, parameter};
    };
    std::vector<ParameterSwitch> found =
        find_switches(expression->steps(), expression->text(), variable, at_instant);
    for (ParameterSwitch& one : found)
      for (const double time : times)
        one.values.emplace_back([expression, time](std::vector<double> numbers) {
          numbers.push_back(time);
          return expression->value(numbers);
        });
    return found;
  }
  int time_index() const { return static_cast<int>(names.size()); }

  std::vector<std::string> names;
  std::vector<double> values;
  std::unordered_map<std::string, int> index;     ///< from name to index in `names` and `values`
  mutable std::vector<ParameterSwitch> switches;  ///< of the parsed expressions
  mutable std::set<int> used;  ///< indices of the parameters on which a parsed expression depends

 private:
  std::function<int(const std::string&)> index_of() const {
    return [this](const std::string& name) {
      const auto found = index.find(name);
      return found == index.end() ? -1 : found->second;
    };
  }
  std::shared_ptr<const Expression> parse(const std::string& text,
                                          const ExpressionScope& scope) const {
    auto expression = std::make_shared<const Expression>(text, scope);
    for (const int k : expression->dependencies())
      if (k != time_index()) used.insert(k);
    for (ParameterSwitch& one : switches_of(expression, {0.37})) switches.push_back(std::move(one));
    return expression;
  }
};

}  // namespace codesign
