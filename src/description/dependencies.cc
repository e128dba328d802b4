// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/dependencies.h"

#include <set>

namespace codesign {
namespace {

using Found = std::set<int>;

void add(const Quantity& quantity, Found* found) {
  if (quantity.is_constant()) return;
  const std::vector<int>& used = quantity.expression()->dependencies();
  found->insert(used.begin(), used.end());
}

void add(const std::vector<Quantity>& quantities, Found* found) {
  for (const Quantity& quantity : quantities) add(quantity, found);
}

void add(const ReferenceDescription& description, Found* found) {
  switch (description.kind) {
    case ReferenceDescription::Kind::kConstant:
      add(description.constant, found);
      break;
    case ReferenceDescription::Kind::kSine: {
      const SineDescription& sine = description.sine;
      add({sine.amplitude, sine.phase, sine.offset, sine.frequency}, found);
      break;
    }
    case ReferenceDescription::Kind::kWaypoints:
      add(description.waypoints.positions, found);
      add(description.waypoints.velocities, found);
      add(description.waypoints.accelerations, found);
      break;
    case ReferenceDescription::Kind::kSampled:
      add({description.sampled.scale, description.sampled.delay, description.sampled.offset}, found);
      break;
    case ReferenceDescription::Kind::kLive:
      add(*description.live.planned, found);
      break;
  }
}

}  // namespace

std::vector<int> dependencies(const ReferenceDescription& description) {
  Found found;
  add(description, &found);
  return {found.begin(), found.end()};
}

std::vector<int> dependencies(const BasisDescription& description) {
  Found found;
  add(description.coefficients, &found);
  return {found.begin(), found.end()};
}

}  // namespace codesign
