// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// A robot with `body` from line 2 on and the parameter length = 0.2 in [0.1, 0.4].
inline SourceText robot_text(const std::string& body, const std::string& name = "test.urdf") {
  return {
      name,
      R"(<robot name="test" xmlns:codesign="urn:x"> <codesign:parameter name="length" value="0.2" lower="0.1" upper="0.4"/>)"
      "\n" +
          body + "\n</robot>\n"};
}

inline const char kGround[] = R"(<link name="ground"/>)";
inline const char kInertial[] =
    R"(<inertial><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>)";

inline std::string link_with(const std::string& name, const std::string& content = kInertial) {
  return "<link name=\"" + name + "\">" + content + "</link>";
}

inline std::string joint_with(const std::string& name, const std::string& type,
                              const std::string& parent, const std::string& child,
                              const std::string& content = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + content + "</joint>";
}

/// ground - hinge - arm, on line 2; then `more` from line 3 on.
inline SourceText hinged_arm(const std::string& joint_content, const std::string& more = "") {
  return robot_text(kGround + link_with("arm") +
                    joint_with("hinge", "continuous", "ground", "arm", joint_content) + "\n" +
                    more);
}

/// `what()` of the InputError that reading throws; the test fails if it throws none.
inline std::string error_of(const SourceText& urdf, const std::vector<SourceText>& overlays = {}) {
  try {
    read_urdf(urdf, overlays);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "read without complaint:\n" << urdf.text;
  return "";
}

/// Expects an error that contains every one of `parts`.
inline void expect_error(const SourceText& urdf, const std::vector<std::string>& parts,
                         const std::vector<SourceText>& overlays = {}) {
  const std::string message = error_of(urdf, overlays);
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in:\n" << message;
}

/// Expects exactly one warning, with this code, that contains every one of `parts`.
inline void expect_warning(const SourceText& urdf, const std::string& code,
                           const std::vector<std::string>& parts,
                           const std::vector<SourceText>& overlays = {}) {
  std::vector<std::string> messages;
  for (const Warning& warning : read_urdf(urdf, overlays).warnings)
    if (warning.code == code) messages.push_back(warning.message);
  ASSERT_EQ(messages.size(), 1U) << code << " in\n" << urdf.text;
  for (const std::string& part : parts)
    EXPECT_NE(messages[0].find(part), std::string::npos) << "no '" << part << "' in:\n"
                                                         << messages[0];
}

inline void expect_no_warning(const SourceText& urdf,
                              const std::vector<SourceText>& overlays = {}) {
  for (const Warning& warning : read_urdf(urdf, overlays).warnings)
    ADD_FAILURE() << warning.code << ": " << warning.message;
}

/// An overlay with `body` on line 2.
inline SourceText overlay_text(const std::string& body) {
  return {"notes.urdf", "<robot name=\"notes\" xmlns:codesign=\"urn:mechanism_codesign\">\n" +
                            body + "\n</robot>"};
}

}  // namespace codesign
