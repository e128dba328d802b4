// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/robot.h"
#include "mechanism_codesign/parameter.h"
#include "reading/xml/xml_document.h"

namespace codesign {

/// Merges an overlay into `base`: its elements are merged with the elements of the same tag and
/// name. New loops, couplings, parameters and spring-dampers are added, also new joints with a type
/// and new links that a joint names. Within an element, a `codesign:` child replaces the child with
/// the same tag and name; the attributes of a plain child replace the attributes of the first such
/// child.
/// @throws InputError naming the overlay's file and line.
void merge_overlay(const XmlDocument& overlay, XmlDocument* base);

inline constexpr const char* kParameterTag = "codesign:parameter";
inline constexpr const char* kSetTag = "codesign:set";

/// Refuses `<codesign:set>` in a model, whose parameters have their values from
/// `<codesign:parameter>`. @throws InputError
void refuse_set_values(const XmlDocument& model);

/// Gives parameters the values of the `<codesign:set>` elements of merged overlays, and takes these
/// elements out. First the model is read and checked at the values that it declares; then all
/// numbers with twins follow the new values, as in write_design().
/// @throws InputError for an unknown parameter, a value that is not a number or outside its bounds,
/// and as read_robot()
void apply_set_values(XmlDocument* document, const Laws& laws);

/// One `<codesign:set>` to be written.
struct SetValue {
  Parameter parameter;  ///< name, and the bounds that the model declares
  double value = 0.0;   ///< a bound that it exceeds is moved to it
  std::string comment;  ///< written above it; may be empty
};

/// An overlay that sets values. @param robot name of the model. @param heading, ending comments at
/// the beginning and the end; may be empty.
std::string write_set_overlay(const std::string& robot, const std::string& heading,
                              const std::vector<SetValue>& values, const std::string& ending);

}  // namespace codesign
