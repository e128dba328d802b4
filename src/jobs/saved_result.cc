// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/saved_result.h"

#include <algorithm>

#include "jobs/json.h"

namespace codesign {
namespace {

constexpr const char* kAllowed = "what codesign optimize writes: {\"parameters\": {NAME: number, ...}, ...}";

Json parse(const SourceText& source) {
  try {
    return Json::parse(source.text);
  } catch (const Json::parse_error& error) {
    const auto end = source.text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, source.text.size()));
    const int line = 1 + static_cast<int>(std::count(source.text.begin(), end, '\n'));
    throw InputError({{source.name, line}, "result", "not JSON", "", kAllowed});
  }
}

}  // namespace

ParameterSettings read_result(const SourceText& json) {
  const Json object = parse(json);
  const auto parameters = object.is_object() ? object.find("parameters") : object.end();
  if (parameters == object.end() || !parameters->is_object())
    throw InputError({{json.name, 0}, "parameters", "the result has no design", "", kAllowed});
  ParameterSettings settings;
  for (const auto& [name, value] : parameters->items()) {
    if (!value.is_number()) throw InputError({{json.name, 0}, "parameters." + name, "not a number", value.dump(), "a number"});
    settings.emplace_back(name, value.get<double>());
  }
  return settings;
}

}  // namespace codesign
