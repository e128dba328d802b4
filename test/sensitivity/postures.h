// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <complex>
#include <string>

#include "mechanism_codesign/problem.h"
#include "paths.h"
#include "problem/load_problem.h"

namespace codesign {

/// A shipped linkage with a study of its own.
inline Problem postures(const std::string& model, const std::string& study) {
  return load_problem(read_source(source_dir() + "/urdf/" + model + ".urdf"), {},
                      {"postures.yaml", study});
}

/// How far the linkage four_bar_function with the links a, b, c is open at two angles [m].
inline double opening(double a, double b, double c, double crank, double rocker) {
  return std::abs(std::polar(a, crank) - 1.0 - std::polar(c, rocker)) - b;
}

}  // namespace codesign
