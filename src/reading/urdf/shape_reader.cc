// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/shape_reader.h"

#include "reading/urdf/quantity_reader.h"

namespace codesign {
namespace {

ShapeDescription read_solid(const XmlElement& visual, const ParameterTable& table) {
  ShapeDescription shape;
  shape.origin = read_origin(visual, table);
  const XmlElement geometry = visual.only("geometry");
  const std::vector<XmlElement> kinds = geometry.children();
  if (kinds.size() != 1) geometry.fail("the geometry does not hold exactly one shape", "", "<box>, <cylinder> or <sphere>");
  const XmlElement& kind = kinds.front();
  if (kind.tag() == "box") {
    shape.kind = ShapeDescription::Kind::kBox;
    shape.size = read_vector(kind, "size", table);
    for (const Quantity& side : shape.size)
      if (side.nominal() <= 0.0) kind.fail_at("size", "the box has no volume", "sides > 0");
  } else if (kind.tag() == "cylinder") {
    shape.kind = ShapeDescription::Kind::kCylinder;
    shape.size[0] = read_quantity(kind, "radius", Range::kPositive, table);
    shape.size[1] = read_quantity(kind, "length", Range::kPositive, table);
  } else if (kind.tag() == "sphere") {
    shape.kind = ShapeDescription::Kind::kSphere;
    shape.size[0] = read_quantity(kind, "radius", Range::kPositive, table);
  } else {
    kind.fail("mass cannot be computed from this shape", "<" + kind.tag() + ">", "<box>, <cylinder> or <sphere>");
  }
  return shape;
}

}  // namespace

std::vector<ShapeDescription> read_solids(const XmlElement& link, const std::string& tag, const ParameterTable& table) {
  std::vector<ShapeDescription> shapes;
  for (const XmlElement& visual : link.children(tag)) shapes.push_back(read_solid(visual, table));
  if (shapes.empty()) link.fail("the link has no <" + tag + "> to compute its mass from");
  return shapes;
}

}  // namespace codesign
