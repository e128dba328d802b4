// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reading/urdf/vocabulary.h"

namespace codesign {

/// An ElementRule whose parts are set by name; those that are not named are empty.
class AnnotationRule {
 public:
  explicit AnnotationRule(std::string path) { rule_.path = std::move(path); }
  AnnotationRule& strict(bool is_strict = true) { return set(&ElementRule::strict, is_strict); }
  AnnotationRule& plain(const std::vector<std::string>& names) {
    return set(&ElementRule::plain, names);
  }
  AnnotationRule& twins(const std::vector<std::string>& names) {
    return set(&ElementRule::twins, names);
  }
  AnnotationRule& own(const std::vector<std::string>& names) {
    return set(&ElementRule::own, names);
  }
  AnnotationRule& children(const std::vector<std::string>& names) {
    return set(&ElementRule::children, names);
  }
  operator ElementRule() const { return rule_; }  // NOLINT(google-explicit-constructor)

 private:
  template <class Part>
  AnnotationRule& set(Part ElementRule::*part, const Part& value) {
    rule_.*part = value;
    return *this;
  }
  ElementRule rule_;
};

// Rules that several elements have.

/// `<predecessor link>` and `<successor link>` with an `<origin>`.
void add_ends(const std::string& path, std::vector<ElementRule>* rules);
/// `<codesign:friction>` where bodies touch.
void add_contact_friction(const std::string& path, std::vector<ElementRule>* rules);
/// The numbers of `<codesign:contact>` and `<codesign:clearance>`.
std::vector<std::string> contact_numbers();

}  // namespace codesign
