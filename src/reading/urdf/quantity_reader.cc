// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/quantity_reader.h"

namespace codesign {
namespace {

void check_range(const XmlElement& element, const std::string& attribute, Range range, double value) {
  if (range == Range::kPositive && value <= 0.0) element.fail_at(attribute, attribute + " is not positive", "> 0");
  if (range == Range::kNonNegative && value < 0.0) element.fail_at(attribute, attribute + " is negative", ">= 0");
}

}  // namespace

Quantity read_quantity(const XmlElement& element, const std::string& attribute, Range range, const ParameterTable& table) {
  Quantity quantity = read_quantities(element, attribute, 1, table).front();
  check_range(element, attribute, range, quantity.nominal());
  return quantity;
}

Quantity read_quantity_or(const Quantity& fallback, const XmlElement& element, const std::string& attribute, Range range,
                          const ParameterTable& table) {
  return element.has(attribute) ? read_quantity(element, attribute, range, table) : fallback;
}

QuantityVector read_vector(const XmlElement& element, const std::string& attribute, const ParameterTable& table) {
  const std::vector<Quantity> values = read_quantities(element, attribute, 3, table);
  return {values[0], values[1], values[2]};
}

QuantityVector read_axis(const XmlElement& element, const ParameterTable& table) {
  QuantityVector axis = read_vector(element, "xyz", table);
  const double x = axis[0].nominal(), y = axis[1].nominal(), z = axis[2].nominal();
  if (x * x + y * y + z * z < 1e-24) element.fail_at("xyz", "the axis is zero", "a vector that is not zero");
  return axis;
}

PoseDescription read_origin(const XmlElement& parent, const ParameterTable& table) {
  PoseDescription pose;
  const std::optional<XmlElement> origin = parent.child("origin");
  if (!origin) return pose;
  if (origin->has("xyz")) pose.xyz = read_vector(*origin, "xyz", table);
  if (origin->has("rpy")) pose.rpy = read_vector(*origin, "rpy", table);
  return pose;
}

double read_number(const XmlElement& element, const std::string& attribute, Range range) {
  return read_quantity(element, attribute, range, ParameterTable()).nominal();
}

double read_number_or(double fallback, const XmlElement& element, const std::string& attribute, Range range) {
  return element.has(attribute) ? read_number(element, attribute, range) : fallback;
}

}  // namespace codesign
