// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_STATE_VIEW_H_
#define MECHANISM_CODESIGN_ELEMENTS_STATE_VIEW_H_

#include <array>
#include <cstdint>
#include <vector>

#include "elements/design.h"
#include "joints/coordinate.h"
#include "math/elementary.h"
#include "system/inverse_dynamics.h"
#include "system/state.h"

namespace codesign {

/// Memory that controllers compute in: one entry per node of the largest driven tree, rates where rotors need them.
template <class T>
struct ControlMemory {
  std::vector<InverseDynamics<T>> inverse_dynamics;  ///< per controller
  std::vector<T> accelerations, by_acceleration, rates, by_rate;
};

/// A coordinate's motion, kept for the elements that ask for it at the same state.
template <class T>
struct KnownCoordinate {
  std::uint64_t version = 0;
  CoordinateDetail detail = CoordinateDetail::kRate;
  CoordinateMotion<T> motion;
};

/// All that elements read: the system, the numbers of one design, and the bodies' motion at one state. Elements get it const; Formulas
/// loads designs and states. Not thread-safe: motions of coordinates are computed when they are first asked for.
template <class T>
struct StateView {
  explicit StateView(const System& of);

  /// Takes the numbers of another design.
  void set_design(const std::vector<T>& parameters);
  /// Takes another state, which must outlive its use.
  void load(const State<T>& at);
  /// A body's motion; -1 is the ground, a body at rest.
  const BodyKinematics<T>& body(int index) const { return kinematics[static_cast<std::size_t>(index < 0 ? layout.bodies : index)]; }
  /// Global column of a local coordinate of a pair, or -1 on the ground.
  int column(int pair, int local) const { return columns[static_cast<std::size_t>(pair)][static_cast<std::size_t>(local)]; }
  const CoordinateConstants<T>& coordinate_constants(int pair, int element) const {
    return design.constants.pairs[static_cast<std::size_t>(pair)].coordinates[static_cast<std::size_t>(element)];
  }
  /// Whether a coordinate depends on the bodies' r, as that of a slide does.
  bool coordinate_moves_r(int pair, int element) const {
    return coordinate_constants(pair, element).kind == CoordinateConstants<T>::Kind::kSlide;
  }
  /// The motion of a joint coordinate, as far as `detail` says.
  const CoordinateMotion<T>& coordinate(int pair, int element, CoordinateDetail detail = CoordinateDetail::kAll) const;
  /// The position of a joint coordinate [m or rad], whole turns counted.
  T coordinate_value(int pair, int element) const;

  const System& system;
  const Layout& layout;
  Design<T> design;
  std::vector<std::array<int, kLocalSize>> columns;  ///< of each pair's local coordinates
  const State<T>* state = nullptr;
  std::vector<BodyKinematics<T>> kinematics;  ///< the ground last
  mutable ControlMemory<T> control;

 private:
  /// What to add to a position so that it continues its reference.
  T whole_turns(int pair, int element, const T& position) const;

  mutable std::vector<std::vector<KnownCoordinate<T>>> coordinates;  ///< per pair and chain element
  std::uint64_t version = 0;                                         ///< of what coordinates depend on
};

template <class T>
StateView<T>::StateView(const System& of) : system(of), layout(of.layout()) {
  kinematics.resize(static_cast<std::size_t>(layout.bodies) + 1);
  kinematics.back().at_rest = true;
  std::size_t nodes = 0;
  for (const Controller& controller : system.controllers()) {
    control.inverse_dynamics.emplace_back(controller.tree);
    nodes = std::max(nodes, controller.tree.nodes.size());
  }
  for (std::vector<T>* of_nodes : {&control.accelerations, &control.by_acceleration, &control.rates, &control.by_rate})
    of_nodes->resize(nodes, T(0.0));
  for (const Pair& pair : system.topology().pairs) {
    std::array<int, kLocalSize>& of_pair = columns.emplace_back();
    for (int local = 0; local < kLocalSize; ++local) {
      const int body = local < kBodySize ? pair.body_i : pair.body_j;
      of_pair[static_cast<std::size_t>(local)] = body < 0 ? -1 : kBodySize * body + local % kBodySize;
    }
  }
}

template <class T>
void StateView<T>::set_design(const std::vector<T>& parameters) {
  ++version;
  design.set(system, parameters);
  if (coordinates.empty())
    for (const PairConstants<T>& pair : design.constants.pairs) coordinates.emplace_back(pair.coordinates.size());
}

template <class T>
void StateView<T>::load(const State<T>& at) {
  ++version;
  state = &at;
  for (int b = 0; b < layout.bodies; ++b) {
    BodyKinematics<T>& k = kinematics[static_cast<std::size_t>(b)];
    const int c = kBodySize * b;
    k.r = at.q.template segment<3>(c);
    k.p = at.q.template segment<4>(c + 3);
    k.rd = at.v.template segment<3>(c);
    k.pd = at.v.template segment<4>(c + 3);
    k.rdd = at.z.template segment<3>(c);
    k.pdd = at.z.template segment<4>(c + 3);
    k.update_rotation();
  }
}

template <class T>
const CoordinateMotion<T>& StateView<T>::coordinate(int pair, int element, CoordinateDetail detail) const {
  KnownCoordinate<T>& known = coordinates[static_cast<std::size_t>(pair)][static_cast<std::size_t>(element)];
  if (known.version == version && known.detail >= detail) return known.motion;
  known.version = version;
  known.detail = detail;
  const Pair& p = system.topology().pairs[static_cast<std::size_t>(pair)];
  const PairConstants<T>& c = design.constants.pairs[static_cast<std::size_t>(pair)];
  known.motion = coordinate_motion(c, c.coordinates[static_cast<std::size_t>(element)], body(p.body_i), body(p.body_j), detail);
  if (detail == CoordinateDetail::kAll) known.motion.position += whole_turns(pair, element, known.motion.position);
  return known.motion;
}

template <class T>
T StateView<T>::coordinate_value(int pair, int element) const {
  const Pair& p = system.topology().pairs[static_cast<std::size_t>(pair)];
  const PairConstants<T>& c = design.constants.pairs[static_cast<std::size_t>(pair)];
  const T position = coordinate_position(c, c.coordinates[static_cast<std::size_t>(element)], body(p.body_i), body(p.body_j));
  return position + whole_turns(pair, element, position);
}

template <class T>
T StateView<T>::whole_turns(int pair, int element, const T& position) const {
  if (coordinate_moves_r(pair, element)) return T(0.0);
  return nearest_turns(state->turns[static_cast<std::size_t>(layout.turn(pair, element))], position);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_STATE_VIEW_H_
