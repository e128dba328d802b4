// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "integration/mechanisms.h"

namespace codesign {

/// One kind of joint between two bodies that fly freely otherwise.
struct JointCase {
  std::string name;
  std::string content;   ///< elements between the bodies `base` and `tip`
  int rows = 0;          ///< constraint rows of the joint and of its coupling
  bool reaction = true;  ///< whether Formulas::reaction() gives all components of F'' and T''
  bool loaded = true;    ///< whether its reaction differs from zero
};

void PrintTo(const JointCase& c, std::ostream* out);

namespace joint_cases {

inline const char* const kInertial =
    "<inertial><origin xyz='0.05 -0.1 0.15' rpy='0.3 0.2 -0.1'/><mass value='0.8' "
    "codesign:value='${mass}'/>"
    "<inertia ixx='0.02' ixy='0.001' ixz='-0.002' iyy='0.018' iyz='0.0005' izz='0.01'/></inertial>";

/// Where the joint sits; `size` moves it.
inline const char* const kOrigin =
    "<origin xyz='0.1 0.2 -0.1' codesign:xyz='${size} 0.2 -0.1' rpy='0.2 -0.3 0.4'/>";

std::string body(const std::string& name);

std::string tree(const std::string& name, const std::string& type, const std::string& parent,
                 const std::string& child, const std::string& axis, const std::string& more = "");

std::string loop(const std::string& type, const std::string& predecessor,
                 const std::string& more = "");

std::string free(const std::string& link);

/// A chain of one-coordinate joints base - ... - tip: 'R' or 'P' and the axis each.
std::string chain(const std::vector<std::pair<char, std::string>>& joints);

std::string model(const JointCase& c);

std::vector<JointCase> trees();

std::vector<JointCase> loops();

/// The joints' own rows and one for the coupling.
std::vector<JointCase> couplings();

std::vector<JointCase> all();

}  // namespace joint_cases
}  // namespace codesign
