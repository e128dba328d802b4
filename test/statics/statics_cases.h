// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "excitation/excited_cases.h"
#include "problem/load_problem.h"

namespace codesign {

constexpr double kGravity = 9.81, kPi = 3.141592653589793;

Problem loaded(const std::string& urdf, const std::string& study);

/// `what()` of the InputError that a function throws; the test fails if it throws none.
template <class Function>
std::string refused(const Function& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return "";
}

std::string body(const std::string& name, double mass, const std::string& centre = "0 0 0");

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& origin, const std::string& axis,
                  const std::string& more = "");

/// A crank of 0.1 m that turns about -y, a rod of 0.3 m without mass, and a slider along x.
std::string planar_slider_crank(const std::string& slider_friction = "");

/// An arm whose centre is 0.5 m above its hinge, at which it turns about y, with a spring of no
/// free length from 0.4 m above the hinge to 0.25 m along the arm. It is balanced if k a b = m g l.
std::string balanced_arm(double mass, double stiffness);

}  // namespace codesign
