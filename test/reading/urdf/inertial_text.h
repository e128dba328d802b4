// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "reading/urdf/urdf_fixture.h"

namespace codesign {

/// A robot of the one link a.
inline SourceText with_inertial(const std::string& inertial, const std::string& visual = "") {
  return robot_text("<link name=\"a\">\n" + inertial + visual + "</link>");
}

/// Its <inertial> with these numbers, written as they stand in the file.
inline SourceText with_numbers(const std::string& mass, const std::string& ixx,
                               const std::string& iyy, const std::string& izz) {
  return with_inertial("<inertial><mass value=\"" + mass + "\"/><inertia ixx=\"" + ixx +
                       "\" ixy=\"0\" ixz=\"0\" iyy=\"" + iyy + "\" iyz=\"0\" izz=\"" + izz +
                       "\"/></inertial>");
}

/// A box as long as the parameter; at its default value it is 2 kg of a density of 1000 kg/m^3.
inline const char kBox[] = R"(<visual><origin xyz="0 0 0.1" codesign:xyz="0 0 ${length/2}"/>
    <geometry><box size="0.1 0.1 0.2" codesign:size="0.1 0.1 ${length}"/></geometry></visual>)";

/// An <inertial> computed from the shapes, and the numbers of kBox for other readers.
inline std::string from_shape(const std::string& density, const std::string& mass,
                              const std::string& ixx = "0.0083333333333333332") {
  return "<inertial codesign:density=\"" + density +
         "\" codesign:from=\"visual\"><origin xyz=\"0 0 0.1\"/><mass value=\"" + mass +
         "\"/><inertia ixx=\"" + ixx +
         "\" ixy=\"0\" ixz=\"0\" iyy=\"0.0083333333333333332\" iyz=\"0\" "
         "izz=\"0.0033333333333333335\"/></inertial>";
}

}  // namespace codesign
