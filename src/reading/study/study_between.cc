// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_between.h"

#include "reading/study/study_values.h"

namespace codesign {

Between read_between(const YamlValue& value, const ParameterTable& table) {
  const auto between = value.find("between"), at_least = value.find("at_least"), at_most = value.find("at_most");
  if (between ? at_least || at_most : !at_least && !at_most)
    value.fail("a constraint needs bounds, either by between or by at_least and at_most",
               "between: [lower, upper]; or at_least, at_most or both");
  Between bounds;
  if (between) {
    const std::vector<YamlValue> items = between->items();
    if (items.size() != 2) between->fail("two bounds are needed, found " + std::to_string(items.size()), "[lower, upper]");
    bounds.lower = read_quantity(items[0], table);
    bounds.upper = read_quantity(items[1], table);
  }
  if (at_least) bounds.lower = read_quantity(*at_least, table);
  if (at_most) bounds.upper = read_quantity(*at_most, table);
  return bounds;
}

}  // namespace codesign
