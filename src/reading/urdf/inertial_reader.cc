// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/inertial_reader.h"

#include <algorithm>

#include "reading/urdf/inertial_check.h"
#include "reading/urdf/quantity_reader.h"
#include "reading/urdf/shape_reader.h"

namespace codesign {
namespace {

constexpr std::array<const char*, 6> kInertia = {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};

InertialDescription read_numbers(const XmlElement& inertial, const ParameterTable& table) {
  InertialDescription result;
  result.where = inertial.where();
  result.origin = read_origin(inertial, table);
  const XmlElement mass = inertial.only("mass");
  result.mass = read_quantity(mass, "value", mass.in_overlay("value") ? Range::kNonNegative : Range::kAny, table);
  const XmlElement inertia = inertial.only("inertia");
  for (std::size_t k = 0; k < kInertia.size(); ++k) result.inertia[k] = read_quantity(inertia, kInertia[k], Range::kAny, table);
  return result;
}

bool is_massless(const InertialDescription& inertial) {
  const auto is_zero = [](const Quantity& quantity) { return quantity.is_zero(); };
  return inertial.mass.is_zero() && std::all_of(inertial.inertia.begin(), inertial.inertia.end(), is_zero);
}

InertialDescription read_from_shapes(const XmlElement& link, const XmlElement& inertial, const ParameterTable& table) {
  InertialDescription result;
  result.where = inertial.where();
  const std::string from = inertial.find("codesign:from").value_or("visual");
  if (from != "visual" && from != "collision") inertial.fail_at("codesign:from", "unknown kind of shapes", "visual or collision");
  result.density = parse_quantities(inertial, "codesign:density", 1, table).front();
  if (result.density->nominal() <= 0.0) inertial.fail_at("codesign:density", "the density is not positive", "> 0");
  result.shapes = read_solids(link, from, table);
  return result;
}

}  // namespace

std::optional<InertialDescription> read_inertial(const XmlElement& link, const ParameterTable& table) {
  const std::optional<XmlElement> inertial = link.child("inertial");
  if (!inertial) return std::nullopt;
  if (!inertial->has("codesign:density")) {
    if (inertial->has("codesign:from"))
      inertial->fail_at("codesign:from", "without codesign:density no mass can be computed from shapes; add it, or remove codesign:from");
    InertialDescription result = read_numbers(*inertial, table);
    if (is_massless(result)) return std::nullopt;
    return result;
  }
  InertialDescription result = read_from_shapes(link, *inertial, table);
  if (!inertial->child("mass") || !inertial->child("inertia"))
    fail_with_computed(*inertial, result, table, "mass or inertia is missing, which other readers of URDF need");
  check_agreement(*inertial, read_numbers(*inertial, table), result, table);
  return result;
}

}  // namespace codesign
