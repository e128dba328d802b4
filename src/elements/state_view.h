// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "elements/design.h"
#include "joints/coordinate.h"
#include "joints/joint_sweep.h"
#include "joints/pair_rows.h"
#include "math/arrays.h"
#include "math/scalar.h"
#include "system/forest_motion.h"
#include "system/inverse_dynamics.h"
#include "system/state.h"
#include "system/system.h"

namespace codesign {

/// Memory that the elements write to during one evaluation of the equations: the loads on the
/// bodies, which several elements add up.
///
/// Order within one evaluation: clear_loads(); then every element that adds loads (pairs,
/// spring-dampers, constant loads on links); then the bodies, which turn the sums into rows of the
/// residual, theory (7).
template <class T>
struct Workspace {
  explicit Workspace(const System& system) {
    loads.resize(to_index(system.layout().bodies));
    if (system.layout().has_forest()) {
      own.resize(loads.size());
      transmitted.resize(loads.size());
    }
    if (!system.sharing().drops()) return;
    shared_loads = loads;
    displaced.resize(loads.size() + 1);
    displaced.back().at_rest = true;
  }

  /// Sets `loads` to zero, before the first element adds to them.
  void clear_loads() {
    for (BodyLoad<T>& load : loads) {
      load.force.setZero();
      load.W.setZero();
    }
    for (Wrench<T>& wrench : own) wrench = {};
  }
  /// The sum of the loads on a body, to which elements add theirs; null for the ground, whose loads
  /// are not needed.
  BodyLoad<T>* load_on(int body) { return body < 0 ? nullptr : &loads[to_index(body)]; }
  /// The same for `shared_loads`.
  BodyLoad<T>* shared_load_on(int body) {
    return body < 0 ? nullptr : &shared_loads[to_index(body)];
  }
  /// A body of `displaced`; -1 is the ground.
  const BodyKinematics<T>& displaced_body(int body) const {
    return body < 0 ? displaced.back() : displaced[to_index(body)];
  }

  /// Per body: f and W of multipliers, spring-dampers and constant forces. They are terms of G, on
  /// the left, so the body feels -f.
  std::vector<BodyLoad<T>> loads;
  /// Per body of a system with a forest: further loads about its centre of mass, in its axes, with
  /// the same sign. Used of bodies of the forest only.
  std::vector<Wrench<T>> own;
  /// Per body of a system with a forest, after the back sweep: of a body of the forest the wrench
  /// that its joint transmits to it, of a free body the sum of the wrenches that its children need;
  /// theory (57).
  std::vector<Wrench<T>> transmitted;
  /// Per body: f and W of the unknowns eta of shared reactions, theory (23b). Empty if no row is
  /// dropped, as is `displaced`.
  std::vector<BodyLoad<T>> shared_loads;
  /// Per body, the ground last: its position without velocity, and the displacement w of (23b) in
  /// place of the acceleration.
  std::vector<BodyKinematics<T>> displaced;
};

/// Memory for the wrenches that the joints of a forest transmit, which elements and signals request
/// when they need them.
template <class T>
struct ForestMemory {
  explicit ForestMemory(const System& system) : workspace(system) {}

  std::uint64_t version = 0;  ///< StateView::version to which Workspace::transmitted belongs
  Workspace<T> workspace;
  VectorX<T> unused;  ///< rows of G that are computed on the way and not needed
};

/// The motion of one joint coordinate, kept while design and state stay the same, because several
/// elements need it.
template <class T>
struct KnownCoordinate {
  std::uint64_t version = 0;  ///< StateView::version when it was computed
  CoordinateDetail detail = CoordinateDetail::kRate;
  CoordinateMotion<T> motion;
};

/// Everything that the elements read: the system, the constants of one design, and the motion of
/// the bodies at one state.
///
/// Formulas sets the design and loads the state; the elements get the view as const. Order:
/// set_design(), then load() for each state, then any number of elements. Not thread-safe, although
/// const: motions of joint coordinates are computed when an element first needs them. No allocation
/// after set_design().
template <class T>
struct StateView {
  /// @param of must outlive the view.
  explicit StateView(const System& of);

  /// Evaluates all constants at `parameters` (all named parameters, order of Study::parameters).
  /// Allocates nothing but the first time.
  void set_design(const std::vector<T>& parameters);
  /// Computes the motion of all bodies from q, v and the accelerations in z. @param at is kept as a
  /// pointer: it must stay alive and unchanged while the view is read.
  void load(const State<T>& at);
  const Pair& pair(int index) const { return system.topology().pairs[to_index(index)]; }
  const PairConstants<T>& constants(int pair) const {
    return design.constants.pairs[to_index(pair)];
  }
  /// Damping, springs, limits and actuator of a joint coordinate.
  const JointDynamicsConstants<T>& dynamics(int pair, int element) const {
    return constants(pair).dynamics[to_index(element)];
  }
  const Controller& controller(int index) const { return system.controllers()[to_index(index)]; }
  const ControllerConstants<T>& controller_numbers(int index) const {
    return design.controllers[to_index(index)];
  }
  /// The motion of a body; -1 is the ground, a body at rest.
  const BodyKinematics<T>& body(int index) const {
    return kinematics[to_index(index < 0 ? layout.bodies : index)];
  }
  /// The entry of q that belongs to one of the 14 local coordinates [r_i, p_i, r_j, p_j] of a pair;
  /// -1 if that body is not free. The same index is the row of motion in G and the column of the
  /// velocity and of the acceleration.
  int column(int pair, int local) const { return columns[to_index(pair)][to_index(local)]; }
  /// The constants of a joint coordinate. @param element index in the pair's chain; a cylindrical
  /// loop has 0 (turn) and 1 (slide).
  const CoordinateConstants<T>& coordinate_constants(int pair, int element) const {
    return design.constants.pairs[to_index(pair)].coordinates[to_index(element)];
  }
  /// The motion of a joint coordinate, theory (8), with the members that `detail` includes; the
  /// position counts whole turns. The referenced object is overwritten when another state is
  /// loaded, or when more detail of the same coordinate is requested.
  const CoordinateMotion<T>& coordinate(int pair, int element,
                                        CoordinateDetail detail = CoordinateDetail::kAll) const;
  /// The position of a joint coordinate [m or rad], whole turns counted, when its rate is not
  /// needed.
  T coordinate_value(int pair, int element) const;

  const System& system;
  const Layout& layout;
  Design<T> design;
  std::vector<std::array<int, kLocalSize>> columns;  ///< per pair, see column()
  /// Set by load(); time, extra states, multipliers and turns are read from it.
  const State<T>* state = nullptr;
  std::vector<BodyKinematics<T>> kinematics;  ///< one per body, the ground last
  ForestMotion<T> motion;                     ///< of the bodies of a forest and of their parents
  mutable std::vector<InverseDynamics<T>> inverse_dynamics;  ///< per controller, theory (C4)
  mutable ForestMemory<T> forest;
  std::uint64_t version = 0;  ///< counts changes of design and state

 private:
  /// The multiple of 2 pi [rad] that brings a position nearest to its turn reference; zero for
  /// slides.
  T whole_turns(int pair, int element, const T& position) const;

  mutable std::vector<std::vector<KnownCoordinate<T>>> coordinates;  ///< per pair and chain element
};

template <class T>
StateView<T>::StateView(const System& of)
    : system(of), layout(of.layout()), motion(of.layout()), forest(of) {
  kinematics.resize(to_index(layout.bodies) + 1);
  kinematics.back().at_rest = true;
  for (const Controller& controller : system.controllers())
    inverse_dynamics.emplace_back(controller.tree);
  for (const Pair& pair : system.topology().pairs) {
    std::array<int, kLocalSize>& of_pair = columns.emplace_back();
    for (int local = 0; local < kLocalSize; ++local) {
      const int body = local < kBodySize ? pair.body_i : pair.body_j;
      of_pair[to_index(local)] =
          body < 0 || !layout.is_free(body) ? -1 : layout.column(body) + local % kBodySize;
    }
  }
}

template <class T>
void StateView<T>::set_design(const std::vector<T>& parameters) {
  ++version;
  design.set(system, parameters);
  if (coordinates.empty())
    for (const PairConstants<T>& pair : design.constants.pairs)
      coordinates.emplace_back(pair.coordinates.size());
}

template <class T>
void StateView<T>::load(const State<T>& at) {
  ++version;
  state = &at;
  for (int b = 0; b < layout.bodies; ++b) {
    if (!layout.is_free(b)) continue;
    BodyKinematics<T>& k = kinematics[to_index(b)];
    const int c = layout.column(b);
    k.r = at.q.template segment<3>(c);
    k.p = at.q.template segment<4>(c + 3);
    k.rd = at.v.template segment<3>(c);
    k.pd = at.v.template segment<4>(c + 3);
    k.rdd = at.z.template segment<3>(c);
    k.pdd = at.z.template segment<4>(c + 3);
    k.update_rotation();
    if (layout.has_forest()) set_free_motion(k, design.gravity, &motion.body(b));
  }
  if (!layout.has_forest()) return;
  sweep_out(system, design.constants, design.gravity, at.q.data(), at.v.data(), at.z.data(),
            &motion);
  for (int b : layout.forest.order)
    set_forest_kinematics(motion.body(b), design.gravity, &kinematics[to_index(b)]);
}

template <class T>
const CoordinateMotion<T>& StateView<T>::coordinate(int pair, int element,
                                                    CoordinateDetail detail) const {
  KnownCoordinate<T>& known = coordinates[to_index(pair)][to_index(element)];
  if (known.version == version && known.detail >= detail) return known.motion;
  known.version = version;
  known.detail = detail;
  const Pair& p = system.topology().pairs[to_index(pair)];
  const PairConstants<T>& c = design.constants.pairs[to_index(pair)];
  known.motion = coordinate_motion(c, c.coordinates[to_index(element)], body(p.body_i),
                                   body(p.body_j), detail);
  if (const int own = layout.element_column(pair, element); own >= 0) {
    known.motion.position = state->q[own];
    known.motion.rate = state->v[own];
    known.motion.acceleration = state->z[own];
    return known.motion;
  }
  if (detail == CoordinateDetail::kAll)
    known.motion.position += whole_turns(pair, element, known.motion.position);
  return known.motion;
}

template <class T>
T StateView<T>::coordinate_value(int pair, int element) const {
  if (const int own = layout.element_column(pair, element); own >= 0) return state->q[own];
  const Pair& p = system.topology().pairs[to_index(pair)];
  const PairConstants<T>& c = design.constants.pairs[to_index(pair)];
  const T position =
      coordinate_position(c, c.coordinates[to_index(element)], body(p.body_i), body(p.body_j));
  return position + whole_turns(pair, element, position);
}

template <class T>
T StateView<T>::whole_turns(int pair, int element, const T& position) const {
  if (coordinate_constants(pair, element).kind == CoordinateConstants<T>::Kind::kSlide)
    return T(0.0);
  return nearest_turns(state->turns[to_index(layout.turn(pair, element))], position);
}

}  // namespace codesign
