// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/contact_watch.h"

#include "assembly/start_overlap.h"
#include "elements/body_contact.h"
#include "equations/formulas.h"
#include "text/number_text.h"

namespace codesign {

ContactWatch::ContactWatch(const CompiledSystem& system)
    : system_(system), deepest_(system.robot().contacts.size()) {}

void ContactWatch::start() { deepest_.assign(system_.robot().contacts.size(), {}); }

void ContactWatch::look(const Formulas<double>& formulas, double t) {
  const StateView<double>& view = formulas.view();
  for (std::size_t k = 0; k < deepest_.size(); ++k) {
    const double overlap = -nearest_point(view, static_cast<int>(k)).gap;
    if (!(overlap > deepest_[k].overlap)) continue;
    deepest_[k] = {
        overlap, smaller_extent(system_.robot().contacts[k], view.design.constants.contacts[k]), t};
  }
}

Warnings ContactWatch::warnings() const {
  Warnings warnings;
  for (std::size_t k = 0; k < deepest_.size(); ++k) {
    const Deepest& of = deepest_[k];
    if (!(of.overlap > kDeepOverlap * of.extent)) continue;
    const ContactDescription& contact = system_.robot().contacts[k];
    warnings.push_back(
        warn("deep_penetration",
             {contact.where, contact.element(),
              "at t = " + readable(of.time) +
                  " s the shapes overlap by more than 5 % of the smaller one, which the law of the "
                  "contact is not made for; a larger stiffness keeps them apart",
              readable(of.overlap, 4) + " m",
              "at most " + readable(kDeepOverlap * of.extent, 4) + " m"}));
  }
  return warnings;
}

}  // namespace codesign
