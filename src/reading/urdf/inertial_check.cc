// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/inertial_check.h"

#include <cmath>

#include "mechanism/mass_properties.h"
#include "text/number_text.h"

namespace codesign {
namespace {

std::string as_xml(const MassProperties<double>& m) {
  const auto attribute = [&](const char* name, int i, int k) {
    return std::string(" ") + name + "=\"" + to_decimal(m.inertia(i, k)) + "\"";
  };
  return "<origin xyz=\"" + format_numbers({m.centre[0], m.centre[1], m.centre[2]}) + "\"/> <mass value=\"" + to_decimal(m.mass) +
         "\"/> <inertia" + attribute("ixx", 0, 0) + attribute("ixy", 0, 1) + attribute("ixz", 0, 2) + attribute("iyy", 1, 1) +
         attribute("iyz", 1, 2) + attribute("izz", 2, 2) + "/>";
}

}  // namespace

void check_agreement(const XmlElement& element, const InertialDescription& written, const InertialDescription& from_shapes,
                     const ParameterTable& table) {
  constexpr double kRelative = 1e-6;
  const MassProperties<double> a = mass_properties(written, table.values), b = mass_properties(from_shapes, table.values);
  const double size = std::sqrt(b.inertia.trace() / b.mass);
  const bool agree = std::abs(a.mass - b.mass) <= kRelative * b.mass &&
                     (a.centre - b.centre).norm() <= kRelative * (size + b.centre.norm()) &&
                     (a.inertia - b.inertia).norm() <= kRelative * b.inertia.norm();
  if (!agree) element.fail("mass, centre or inertia differ from those of the shapes", as_xml(a), as_xml(b));
}

void fail_with_computed(const XmlElement& element, const InertialDescription& from_shapes, const ParameterTable& table,
                        const std::string& message) {
  element.fail(message, "", as_xml(mass_properties(from_shapes, table.values)));
}

}  // namespace codesign
