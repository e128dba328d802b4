// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/body_contact.h"
#include "elements/spring_damper.h"
#include "elements/state_view.h"

namespace codesign {

// The kinds of elements between two links, as for_each_link_element_kind() has them: how many a
// mechanism has, what the k-th one adds to Workspace::loads (before body_residual()), its energy
// [J] and its power of one kind [W], theory (14b), (14c). Loads, balance of energy and powers
// follow.

struct SpringDampers {
  template <class T>
  static std::size_t count(const StateView<T>& view) {
    return view.design.constants.springs.size();
  }
  template <class T>
  static void add_load(const StateView<T>& view, Workspace<T>* workspace, std::size_t k) {
    add_spring_load(view, workspace, k, spring_at(view, k));
  }
  template <class T>
  static T energy(const StateView<T>& view, std::size_t k) {
    return spring_energy_at(view, k);
  }
  static bool has_power(PowerKind kind) { return kind == PowerKind::kDamping; }
  template <class T>
  static T power(const StateView<T>& view, PowerKind, std::size_t k) {
    return spring_power(view, k);
  }
};

struct BodyContacts {
  template <class T>
  static std::size_t count(const StateView<T>& view) {
    return view.design.constants.contacts.size();
  }
  template <class T>
  static void add_load(const StateView<T>& view, Workspace<T>* workspace, std::size_t k) {
    add_body_contact(view, workspace, k);
  }
  template <class T>
  static T energy(const StateView<T>& view, std::size_t k) {
    return body_contact_energy(view, k);
  }
  static bool has_power(PowerKind kind) {
    return kind == PowerKind::kDamping || kind == PowerKind::kFriction;
  }
  template <class T>
  static T power(const StateView<T>& view, PowerKind kind, std::size_t k) {
    return body_contact_power(view, kind, k);
  }
};

/// Calls visit(kind) with each of these.
template <class Visit>
void for_each_link_element_values(const Visit& visit) {
  visit(SpringDampers());
  visit(BodyContacts());
}

/// Adds what all of them load bodies with.
template <class T>
void add_link_elements(const StateView<T>& view, Workspace<T>* workspace) {
  for_each_link_element_values([&](const auto& kind) {
    for (std::size_t k = 0; k < kind.count(view); ++k) kind.add_load(view, workspace, k);
  });
}

/// Adds the elastic energy of all of them [J].
template <class T>
void add_link_element_energy(const StateView<T>& view, T* energy) {
  for_each_link_element_values([&](const auto& kind) {
    for (std::size_t k = 0; k < kind.count(view); ++k) *energy += kind.energy(view, k);
  });
}

/// Adds the power of one kind of all of them [W].
template <class T>
void add_link_element_power(const StateView<T>& view, PowerKind of, T* power) {
  for_each_link_element_values([&](const auto& kind) {
    for (std::size_t k = 0; kind.has_power(of) && k < kind.count(view); ++k)
      *power += kind.power(view, of, k);
  });
}

}  // namespace codesign
