// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_DESIGN_H_
#define MECHANISM_CODESIGN_ELEMENTS_DESIGN_H_

#include <vector>

#include "control/controller_constants.h"
#include "control/reference.h"
#include "joints/pair_rows.h"
#include "mechanism/constants.h"
#include "system/system.h"

namespace codesign {

/// A constant wrench at one design.
template <class T>
struct ConstantWrench {
  Vector3<T> force,
      torque;        ///< in the root's axes; of a load that turns with its link in the body's, with the torque about the centre of mass
  Vector3<T> point;  ///< in body coordinates [m]
};

/// The terms of an objective at one design.
template <class T>
struct ObjectiveNumbers {
  std::vector<T> weights;
  std::vector<Reference<T>> references;
};

/// All numbers of one design: what model and study say, evaluated at one set of parameters.
template <class T>
struct Design {
  std::vector<T> parameters;  ///< all named parameters (Study::parameters order)
  Constants<T> constants;
  std::vector<PairRows<T>> rows;  ///< per pair
  std::vector<ControllerConstants<T>> controllers;
  ObjectiveNumbers<T> integral, terminal;
  std::vector<T> efforts;                   ///< of Study::loads, along joints [N or N m]
  std::vector<ConstantWrench<T>> wrenches;  ///< of System::link_loads()
  Vector3<T> gravity;                       ///< [m/s^2], in the root link's frame

  /// Evaluates everything at `values`. Allocates.
  void set(const System& system, const std::vector<T>& values);
};

/// The study's constant loads; theory (13g).
template <class T>
void set_constant_loads(const System& system, Design<T>* design) {
  const std::vector<T>& parameters = design->parameters;
  design->efforts.clear();
  for (const LoadDescription& load : system.study().loads) design->efforts.push_back(load.effort.at(parameters));
  design->wrenches.clear();
  for (const LinkLoad& on_link : system.link_loads()) {
    const LoadDescription& load = system.study().loads[static_cast<std::size_t>(on_link.load)];
    const LinkConstants<T>& link = design->constants.links[static_cast<std::size_t>(on_link.link)];
    const auto vector = [&parameters](const QuantityVector& q) {
      return Vector3<T>(q[0].at(parameters), q[1].at(parameters), q[2].at(parameters));
    };
    ConstantWrench<T> wrench{vector(load.force), vector(load.torque), link.R * vector(load.point) + link.s};
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
  for (int k = 0; k < 3; ++k) gravity[k] = T(system.study().gravity[static_cast<std::size_t>(k)]);
  constants = evaluate_constants(system.robot(), system.topology(), parameters);
  set_constant_loads(system, this);
  rows.clear();
  for (std::size_t k = 0; k < constants.pairs.size(); ++k) rows.push_back(pair_rows(system.topology().pairs[k].kind, constants.pairs[k]));
  const Study& study = system.study();
  controllers.clear();
  for (const ControllerDescription& description : study.controllers) controllers.push_back(controller_constants(description, parameters));
  const auto evaluate = [this](const std::vector<ObjectiveTerm>& terms, ObjectiveNumbers<T>* numbers) {
    numbers->weights.clear();
    numbers->references.clear();
    for (const ObjectiveTerm& term : terms) {
      numbers->weights.push_back(term.weight.at(parameters));
      numbers->references.emplace_back(term.reference, parameters);
    }
  };
  evaluate(study.integral, &integral);
  evaluate(study.terminal, &terminal);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_DESIGN_H_
