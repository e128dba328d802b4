// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "description/robot.h"
#include "mechanism_codesign/source_text.h"
#include "reading/xml/xml_document.h"

namespace codesign {

/// Reads an annotated URDF merged with its overlays; doc/annotations.md. Annotations and overlays
/// are read strictly; doubtful parts of a vendor's URDF become warnings. @param laws that the files
/// and their study may name; RobotDescription::laws.
/// @throws InputError naming file, line, element, value and allowed range.
RobotDescription read_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays = {},
                           const Laws& laws = standard_laws());

/// The merged URDF as XML for other parameter values: every attribute with a twin, every
/// parameter's default and every inertial computed from shapes is set to its value at `parameters`
/// (all named parameters; those after the model's are ignored). Reading it gives a model whose
/// default design is this one.
/// @param law the friction law of every joint and loop with friction; numbers that it does not use
/// are left out. Without it each keeps its own. @param laws as of read_urdf(). @throws InputError
/// if values are missing or not finite.
std::string write_tuned_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays,
                             const std::vector<double>& parameters,
                             std::optional<FrictionModel> law = std::nullopt,
                             const Laws& laws = standard_laws());

/// The plain attributes beside twins: as written, or made from the twins at the parameters'
/// defaults, whatever is written.
enum class PlainNumbers { kAsWritten, kFilledIn };

/// The merged URDF as XML, each plain attribute that has a twin filled in at the parameters'
/// defaults; it may have been missing. Each line of the text knows its place in the files.
/// @throws InputError as read_urdf() for everything else.
SourceText write_filled_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays,
                             const Laws& laws = standard_laws());

/// Parses the URDF, merges the overlays and checks all element and attribute names. @throws
/// InputError
XmlDocument load_annotated_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays,
                                const Laws& laws = standard_laws(),
                                PlainNumbers plain = PlainNumbers::kAsWritten);

/// Sets the plain attribute beside each twin to its value at the parameters' defaults.
void fill_in_twins(XmlDocument* document);

/// The mechanism that the document describes, with the warnings of the document and of reading it.
/// @throws InputError
RobotDescription read_robot(const XmlDocument& document, const Laws& laws = standard_laws());

/// Gives the parameters of a document other defaults. Every attribute with a twin and every
/// inertial computed from shapes follows. A bound that a value exceeds is moved to the value, so
/// that the document stays valid.
/// @param robot as read_robot() reads the document. @param values of its parameters, in their
/// order. @throws InputError if a value, or the value of a twin, is not finite
void write_design(const RobotDescription& robot, const std::vector<double>& values,
                  XmlDocument* document);

}  // namespace codesign
