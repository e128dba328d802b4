// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linear/linear_study.h"
#include "linear/loop_margins.h"
#include "linear/poles.h"
#include "linear/state_space.h"
#include "mechanism_codesign/status.h"
#include "system/system.h"

namespace codesign {

/// What is asked of a linearization.
struct LinearQuestion {
  std::vector<SignalDescription> outputs;
  LinearFriction friction = LinearFriction::kOff;  ///< at rest; in motion all of it counts
  bool with_loops = false;  ///< whether margins of the controllers are wanted
};

/// What is linearized.
struct LinearCase {
  const System* system = nullptr;  ///< of the state, or of the mechanism whose posture it is
  std::vector<double> parameters;  ///< all named ones
  LinearQuestion question;
  bool at_rest = true;              ///< at a posture at rest; else at an instant of a run
  std::vector<double> integrals{};  ///< at rest: the state of each controller's integral
};

/// A pole and how the joints move in it.
struct LinearMode {
  Pole pole;
  /// Rates of LinearModel::joints, the largest one 1; of a damped motion those in phase with it.
  /// All zero if no joint with one coordinate takes part.
  std::vector<double> rates;
};

/// The loop of a controller, opened at its output.
struct ControllerLoop {
  std::string controller;
  /// in the common period of all controllers; several: margins are those of PeriodicLoop; 0:
  /// beside sampled controllers, those of FlowingLoop
  int samples = 1;
  LoopMargins margins;
  std::vector<double> frequencies;             ///< [rad/s], ascending
  std::vector<std::complex<double>> response;  ///< L at them
};

/// A mechanism with its controllers about a state, theory (67)-(69).
struct LinearModel {
  Status status;
  StateSpace system;  ///< closed loops; of one period if a controller is sampled
  double duration = 0.0;
  std::vector<std::string> joints;  ///< joints with one coordinate
  std::vector<LinearMode> modes;    ///< the least stable one first
  Stability stability = Stability::kStable;
  std::vector<ControllerLoop> loops;  ///< of the controllers that drive a joint
  /// "stable: slowest pole -0.8 1/s; damping and controllers counted, friction not".
  std::string verdict;
};

/// The study of a case without what is judged, whose watched signals are the outputs, then the
/// outputs of its controllers.
Study bare_study(const LinearCase& of);

/// @param state at rest: positions; else the whole state of the system, consistent. @param theta
/// tree coordinates of the start, Observer::observe().
/// @throws InputError for outputs that do not exist, and as sample_pattern().
LinearModel linear_model(const LinearCase& of, const State<double>& state,
                         const VectorX<double>& theta);

/// Calls visit(name, value, unit) for the margins of a loop, std::optional<AtFrequency>.
template <class Visit>
void visit_margins(const LoopMargins& margins, const Visit& visit) {
  visit("gain_margin", margins.gain_margin, "-");
  visit("gain_reduction", margins.gain_reduction, "-");
  visit("phase_margin", margins.phase_margin, "rad");
  visit("delay_margin", margins.delay_margin, "s");
  visit("bandwidth", margins.bandwidth, "rad/s");
  visit("sensitivity", margins.sensitivity, "-");
  visit("complementary_sensitivity", margins.complementary, "-");
}

}  // namespace codesign
