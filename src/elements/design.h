// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "control/controller.h"
#include "control/reference.h"
#include "joints/pair_rows.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "system/system.h"

namespace codesign {

/// A constant load on a link, theory (13g), with the numbers of one design. Components are in the
/// root link's axes, or in the axes of the body if LinkLoad::turns.
template <class T>
struct ConstantWrench {
  /// [N], acting at `point`; [N m]. If LinkLoad::turns the torque includes the moment of the force
  /// about the centre of mass.
  Vector3<T> force, torque;
  Vector3<T> point;  ///< point of action in body coordinates, from the centre of mass [m]
};

/// The numbers of the objective's terms, theory (21), one per term of Study::integral or
/// Study::terminal.
template <class T>
struct ObjectiveNumbers {
  std::vector<T> weights;
  std::vector<Reference<T>> references;
};

/// One design: every number of model and study that the equations need, evaluated at one set of
/// parameter values. With T = Lanes<N> the numbers carry their derivatives by the parameters.
template <class T>
struct Design {
  std::vector<T> parameters;      ///< all named parameters, order of Study::parameters
  Constants<T> constants;         ///< masses, geometry, springs and couplings of the model
  std::vector<PairRows<T>> rows;  ///< constraint rows, one entry per pair of the topology
  std::vector<ControllerConstants<T>> controllers;  ///< order of Study::controllers
  ObjectiveNumbers<T> integral,
      terminal;                       ///< the integrand g and the terminal terms w of theory (21)
  std::vector<Reference<T>> watched;  ///< the references of Study::watched, theory (21a)
  std::vector<T> efforts;  ///< one per entry of Study::loads [N or N m]; read for loads on joints
  std::vector<ConstantWrench<T>> wrenches;  ///< one per entry of System::link_loads()
  Vector3<T> gravity;                       ///< [m/s^2], in the root link's axes

  /// Evaluates all members at `values`, one value per named parameter. A later design of the same
  /// system allocates nothing.
  void set(const System& system, const std::vector<T>& values);

  MassWorkspace<T> mass_workspace;  ///< workspace of set()
};

/// Evaluates Design::efforts and Design::wrenches, theory (13g), from the design's parameters and
/// link constants, which must be set before.
template <class T>
void set_constant_loads(const System& system, Design<T>* design) {
  const std::vector<T>& parameters = design->parameters;
  design->efforts.clear();
  for (const LoadDescription& load : system.study().loads)
    design->efforts.push_back(load.effort.at(parameters));
  design->wrenches.clear();
  for (const LinkLoad& on_link : system.link_loads()) {
    const LoadDescription& load = system.study().loads[to_index(on_link.load)];
    const LinkConstants<T>& link = design->constants.links[to_index(on_link.link)];
    const auto vector = [&parameters](const QuantityVector& q) {
      return Vector3<T>(q[0].at(parameters), q[1].at(parameters), q[2].at(parameters));
    };
    ConstantWrench<T> wrench{vector(load.force), vector(load.torque),
                             link.R * vector(load.point) + link.s};
    if (on_link.turns) {
      wrench.force = link.R * wrench.force;
      wrench.torque = link.R * wrench.torque + cross<T>(wrench.point, wrench.force);
    }
    design->wrenches.push_back(wrench);
  }
}

template <class T>
void Design<T>::set(const System& system, const std::vector<T>& values) {
  parameters = values;
  for (int k = 0; k < 3; ++k) gravity[k] = T(system.study().gravity[to_index(k)]);
  evaluate_constants(system.robot(), system.topology(), parameters, &mass_workspace, &constants);
  set_constant_loads(system, this);
  rows.resize(constants.pairs.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
    pair_rows(system.topology().pairs[k].kind, constants.pairs[k], &rows[k]);
  const MotionStudy& study = system.study();
  controllers.resize(study.controllers.size());
  for (std::size_t k = 0; k < controllers.size(); ++k)
    controller_constants(study.controllers[k], parameters, &controllers[k]);
  const auto evaluate = [this](const std::vector<ObjectiveTerm>& terms,
                               ObjectiveNumbers<T>* numbers) {
    numbers->weights.clear();
    numbers->references.resize(terms.size());
    for (std::size_t k = 0; k < terms.size(); ++k) {
      numbers->weights.push_back(terms[k].weight.at(parameters));
      numbers->references[k].set(terms[k].reference, parameters);
    }
  };
  evaluate(study.integral, &integral);
  evaluate(study.terminal, &terminal);
  watched.resize(study.watched.size());
  for (std::size_t k = 0; k < watched.size(); ++k)
    watched[k].set(study.watched[k].reference, parameters);
}

}  // namespace codesign
