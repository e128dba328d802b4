// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "description/solver_options.h"

namespace codesign {

/// The enumerator that study files spell as `name`. @throws std::invalid_argument for an unknown
/// name.
template <class Enumeration, class Names>
Enumeration enumerator_named(const Names& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw std::invalid_argument(name);
  return static_cast<Enumeration>(found - names.begin());
}

inline IntegratorKind integrator_named(const std::string& name) {
  return enumerator_named<IntegratorKind>(kIntegratorNames, name);
}
inline RosenbrockMethod method_named(const std::string& name) {
  return enumerator_named<RosenbrockMethod>(kRosenbrockMethodNames, name);
}
inline GradientMethod gradient_named(const std::string& name) {
  return enumerator_named<GradientMethod>(kGradientMethodNames, name);
}

}  // namespace codesign
