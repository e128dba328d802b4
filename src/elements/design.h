// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <type_traits>
#include <vector>

#include "control/controller.h"
#include "control/reference.h"
#include "joints/pair_rows.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "mechanism/machine_numbers.h"
#include "system/system.h"

namespace codesign {

/// A load of the study, theory (13g), with the numbers of one design. Where System::load_signals()
/// has a signal, its value counts in place of the function of time.
template <class T>
struct LoadNumbers {
  Reference<T> effort;                        ///< of a joint [N or N m]
  std::array<Reference<T>, 3> force, torque;  ///< of a link [N], [N m], in the axes of the load
  Vector3<T> point;  ///< where the force acts, in body coordinates, from the centre of mass [m]
};

/// The numbers of the objective's terms, theory (21), one per term of Study::integral or
/// Study::terminal.
template <class T>
struct ObjectiveNumbers {
  std::vector<T> weights;
  std::vector<T> scales;  ///< of losses; 1 where a loss has none
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
  /// the integrand g and the terminal terms w of theory (21)
  ObjectiveNumbers<T> integral, terminal;
  std::vector<Reference<T>> watched;  ///< the references of Study::watched, theory (21a)
  std::vector<LoadNumbers<T>> loads;  ///< order of Study::loads
  Reference<T> clock;                 ///< the time; of recordings if System::reads_time()
  std::vector<Reference<T>> motion;   ///< order of Study::motion, theory (8b)
  Vector3<T> gravity;                 ///< [m/s^2], in the root link's axes

  /// Evaluates all members at `values`, one value per named parameter. A later design of the same
  /// system allocates nothing.
  void set(const System& system, const std::vector<T>& values);

  MassWorkspace<T> mass_workspace;  ///< workspace of set()
  MachineScale<T> scale;            ///< likewise
};

/// Evaluates Design::loads, theory (13g), from the design's parameters and link constants, which
/// must be set before.
template <class T>
void set_loads(const System& system, Design<T>* design) {
  const std::vector<LoadDescription>& loads = system.study().loads;
  design->loads.resize(loads.size());
  for (std::size_t k = 0; k < loads.size(); ++k) {
    LoadNumbers<T>& numbers = design->loads[k];
    numbers.effort.set(loads[k].effort.of_time, design->parameters);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      numbers.force[axis].set(loads[k].force[axis].of_time, design->parameters);
      numbers.torque[axis].set(loads[k].torque[axis].of_time, design->parameters);
    }
  }
  for (const LinkLoad& on_link : system.link_loads()) {
    const QuantityVector& point = loads[to_index(on_link.load)].point;
    const LinkConstants<T>& link = design->constants.links[to_index(on_link.link)];
    const Vector3<T> in_link(point[0].at(design->parameters), point[1].at(design->parameters),
                             point[2].at(design->parameters));
    design->loads[to_index(on_link.load)].point = link.R * in_link + link.s;
  }
}

template <class T>
void Design<T>::set(const System& system, const std::vector<T>& values) {
  parameters = values;
  for (int k = 0; k < 3; ++k) gravity[k] = T(system.study().gravity[to_index(k)]);
  evaluate_constants(system.robot(), system.topology(), parameters, &mass_workspace, &constants);
  set_machine_numbers(system.robot(), system.topology(), system.study(), parameters, &scale,
                      &constants);
  set_loads(system, this);
  // Observers may read more signals than the study. What is recorded has the time only if needed.
  if (!std::is_same_v<T, Traced> || system.reads_time()) clock.set(clock_function(), parameters);
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
    numbers->scales.clear();
    numbers->references.resize(terms.size());
    for (std::size_t k = 0; k < terms.size(); ++k) {
      numbers->weights.push_back(terms[k].weight.at(parameters));
      numbers->scales.push_back(terms[k].loss->has_scale ? terms[k].scale.at(parameters) : T(1.0));
      numbers->references[k].set(terms[k].reference, parameters);
    }
  };
  evaluate(study.integral, &integral);
  evaluate(study.terminal, &terminal);
  motion.resize(study.motion.size());
  for (std::size_t k = 0; k < motion.size(); ++k)
    motion[k].set(study.motion[k].position, parameters);
  watched.resize(study.watched.size());
  for (std::size_t k = 0; k < watched.size(); ++k)
    watched[k].set(study.watched[k].reference, parameters);
}

}  // namespace codesign
