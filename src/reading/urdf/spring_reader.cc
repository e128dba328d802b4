// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <tuple>

#include "reading/urdf/annotation_rules.h"
#include "reading/urdf/joint_reader.h"
#include "reading/urdf/quantity_reader.h"

namespace codesign {

void read_link_element(const XmlElement& element, const ReadContext& context,
                       SpringDamperDescription* spring) {
  spring->where = element.where();
  spring->name = element.text("name");
  std::tie(spring->predecessor, spring->successor) = context.ends(element);
  spring->predecessor_origin = read_origin(element.only("predecessor"), context.table);
  spring->successor_origin = read_origin(element.only("successor"), context.table);
  spring->stiffness = read_quantity(element, "stiffness", Range::kNonNegative, context.table);
  spring->damping = read_quantity_or(0.0, element, "damping", Range::kNonNegative, context.table);
  spring->free_length =
      read_quantity_or(0.0, element, "free_length", Range::kNonNegative, context.table);
}

void add_rules_of(const std::vector<SpringDamperDescription>&, const std::string& path,
                  std::vector<ElementRule>* rules) {
  rules->push_back(AnnotationRule(path)
                       .strict()
                       .plain({"name"})
                       .twins({"stiffness", "damping", "free_length"})
                       .children({"predecessor", "successor"}));
  add_ends(path, rules);
}

}  // namespace codesign
