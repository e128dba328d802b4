// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/parameter_table.h"

namespace codesign {

ParameterTable::ParameterTable(const std::vector<Parameter>& parameters) {
  for (const Parameter& parameter : parameters) {
    index.emplace(parameter.name, static_cast<int>(names.size()));
    names.push_back(parameter.name);
    values.push_back(parameter.value);
  }
}

std::shared_ptr<const Expression> ParameterTable::parse(const std::string& text) const {
  const ExpressionScope scope{[this](const std::string& name) {
                                const auto found = index.find(name);
                                return found == index.end() ? -1 : found->second;
                              },
                              [this] { return names; }};
  auto expression = std::make_shared<const Expression>(text, scope);
  used.insert(expression->dependencies().begin(), expression->dependencies().end());
  return expression;
}

}  // namespace codesign
