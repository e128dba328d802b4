// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "benchmark/robots.h"
#include "problem/load_problem.h"

namespace codesign {

/// A robot of the comparison with other programs. A parameter scales the mass of a link, together
/// with its inertia, or the damping of its joint; it is 1 in the model.
struct PeerCase {
  std::string name;
  Robot robot;
  std::vector<std::pair<std::string, int>> parameters;  ///< "mass" or "damping", index of the link
};

/// Motions without parameters, gradients, and the identification of parameters.
std::vector<PeerCase> peer_cases();

/// The case with its parameters. @param solver entries of the study's block `solver`. @param rest
/// further blocks of the study.
Problem peer_problem(const PeerCase& of, const std::string& solver, const std::string& rest);

/// The objective of the gradients: the sum of the squares of all positions at the end.
std::string sum_of_squares(const Robot& robot);

/// The robot with one of its parameters at another value.
Robot with_parameter(const PeerCase& of, std::size_t parameter, double value);

/// Rows of a recording, positions and then velocities of all joints, at 100 Hz.
std::vector<std::vector<double>> peer_recording(const PeerCase& of);
constexpr double kPeerRate = 100.0;

/// NAME.urdf, as other programs read it, and NAME.json: duration, names and positions of the joints
/// at the start, parameters; of an identification also the recording.
void write_peer_case(const PeerCase& of, const std::string& folder);

}  // namespace codesign
