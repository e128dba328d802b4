// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/record_json.h"

namespace codesign {

double to_number(const Json& json) {
  if (!json.is_string()) return json.get<double>();
  const std::optional<double> number = parse_number(json.get<std::string>());
  if (!number) throw std::invalid_argument("not a number: " + json.get<std::string>());
  return *number;
}

}  // namespace codesign
