// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/start_overlap.h"

#include <algorithm>

#include "elements/body_contact.h"
#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "equations/formulas.h"
#include "text/number_text.h"

namespace codesign {

double smaller_extent(const ContactDescription& contact, const ContactConstants<double>& c) {
  return std::min(extent_of(*contact.surface.shape, c.surface.shape),
                  extent_of(*contact.points.shape, c.points.shape));
}

Warnings find_overlaps(const CompiledSystem& system, const State<double>& state,
                       Equations<double>* equations) {
  Warnings warnings;
  if (system.study().postures > 0) return warnings;
  equations->formulas().load(state);
  const StateView<double>& view = equations->formulas().view();
  for (std::size_t k = 0; k < system.robot().contacts.size(); ++k) {
    const ContactDescription& contact = system.robot().contacts[k];
    const double extent = smaller_extent(contact, view.design.constants.contacts[k]),
                 overlap = -nearest_point(view, static_cast<int>(k)).gap;
    if (!(overlap > kDeepOverlap * extent)) continue;
    const std::string value = readable(overlap, 4) + " m";
    if (overlap > extent)
      throw InputError({contact.where, contact.element(),
                        "at the start the shapes overlap by more than the smaller one, so that the "
                        "contact would push them apart on the wrong side",
                        value, "less than " + readable(extent, 4) + " m; begin with a gap"});
    append({warn("start_overlaps",
                 {contact.where, contact.element(),
                  "at the start the shapes overlap by more than 5 % of the smaller one, which "
                  "holds " +
                      readable(body_contact_energy(view, k), 4) +
                      " J and throws them apart; begin with a gap, or nearer to rest",
                  value, "at most " + readable(kDeepOverlap * extent, 4) + " m"})},
           &warnings);
  }
  return warnings;
}

}  // namespace codesign
