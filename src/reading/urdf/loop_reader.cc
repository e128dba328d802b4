// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <tuple>

#include "reading/urdf/joint_reader.h"
#include "reading/urdf/quantity_reader.h"

namespace codesign {
namespace {

void read_type_specific(const XmlElement& element, const ReadContext& context, JointDescription* loop) {
  const std::optional<XmlElement> second_axis = element.child("codesign:second_axis"), length = element.child("codesign:length");
  if (second_axis) {
    if (loop->type != JointType::kUniversal) second_axis->fail("only a loop of type codesign:universal has a second axis");
    loop->second_axis = read_axis(*second_axis, context.table);
  }
  if (length && loop->type != JointType::kDistance) length->fail("only a loop of type codesign:distance has a length");
  if (loop->type == JointType::kDistance)
    loop->distance = read_quantity(element.only("codesign:length"), "value", Range::kPositive, context.table);
}

}  // namespace

JointDescription read_loop(const XmlElement& element, const ReadContext& context) {
  JointDescription loop;
  loop.is_loop = true;
  loop.where = element.where();
  loop.name = element.text("name");
  read_joint_type(element, *context.laws, &loop);
  std::tie(loop.parent, loop.child) = context.ends(element);
  loop.origin = read_origin(element.only("predecessor"), context.table);
  loop.child_origin = read_origin(element.only("successor"), context.table);
  read_joint_parts(element, context, &loop);
  read_type_specific(element, context, &loop);
  return loop;
}

}  // namespace codesign
