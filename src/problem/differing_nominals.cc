// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/differing_nominals.h"

#include <algorithm>
#include <cmath>

#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kEqual = 1e-6;  // relative to the value, or to its standard deviation if that is larger

}  // namespace

Warnings differing_nominals(const Study& study) {
  std::string values, identified;
  SourceLocation where;
  for (const UncertainQuantity& quantity : study.ensemble.uncertain) {
    if (!quantity.is_identified) continue;
    const double nominal = study.parameters[static_cast<std::size_t>(quantity.parameter)].value, found = quantity.distribution.mean;
    if (std::abs(nominal - found) <= kEqual * std::max(std::abs(found), quantity.spread)) continue;
    values += (values.empty() ? "" : ", ") + quantity.name + " " + readable(nominal);
    identified += (identified.empty() ? "" : ", ") + readable(found);
    where = quantity.where;
  }
  if (values.empty()) return {};
  return {warn("nominal_differs",
               {where, "uncertain.from",
                "samples lie around the identified values, but nominal runs use other values; give identified_overlay.urdf as an overlay",
                values, identified})};
}

}  // namespace codesign
