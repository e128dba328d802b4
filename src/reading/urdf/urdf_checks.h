// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"
#include "reading/xml/xml_document.h"

namespace codesign {

/// Whether a list has a name.
bool contains(const std::vector<std::string>& names, const std::string& name);

/// Checks that `<robot>` declares `xmlns:codesign` if the file has names with that prefix. Called
/// for each file before they are merged.
/// @throws InputError
void check_namespace(const XmlDocument& document);

/// Checks the `codesign:` elements and attributes: names, places, and that each twin has its plain
/// attribute. Inside `<loop>`, `<coupling>` and our own elements unknown names are errors too;
/// other elements and attributes are ignored.
/// @throws InputError with the nearest name or the allowed places
void check_annotations(const XmlDocument& document);

/// Checks the names without our prefix and repeated elements. In a vendor's file, names that no
/// reader of URDF knows and repeated elements, of which readers use the first one, give warnings
/// only. In an overlay they are errors; repeated annotations are errors anywhere.
/// @throws InputError with the nearest name.
void check_vocabulary(const XmlDocument& document, Warnings* warnings);

/// Checks for a misspelt prefix (`codesing:`) and for another prefix that is declared for our
/// namespace. @throws InputError
void check_prefixes(const XmlDocument& document);

/// Warnings (`after_robot`) of elements and text after `<robot>`, which readers of URDF ignore.
Warnings check_surroundings(const XmlDocument& document);

/// Checks that an overlay has no text between its elements, since it would be lost. @throws
/// InputError
void refuse_text(const XmlDocument& overlay);

/// Removes text after the last `</robot>`, which the XML parser would reject and other readers of
/// URDF ignore. Returns a warning if there was any.
Warnings cut_trailing_text(SourceText* source);

/// Checks that urdfdom, the parser of robot_state_publisher and rviz, accepts the document.
/// @throws InputError with urdfdom's message, located at the element that it names, else at the
/// root.
void check_with_urdfdom(const XmlDocument& document);

/// Checks that names are unique: among links, among joints and loops, among couplings, among
/// spring-dampers, among contacts. @throws InputError
void check_names(const RobotDescription& robot);

/// For a link that is the child of several joints: keeps as tree joint the joint by which a walk
/// from the root reaches the link first. In a vendor's file the other joints become loops, with a
/// warning (`second_parent`). Called before `<loop>` elements are added.
void close_with_second_parents(RobotDescription* robot);

/// Index of the tree's root link.
/// @throws InputError if a link is the child of two joints, if there is no root or more than one,
/// or if joints form a ring.
int find_root(const RobotDescription& robot);

/// Checks that every `<mimic>` names another joint with one coordinate or none, and that joints do
/// not mimic each other in a ring. In a vendor's file a wrong `<mimic>` is dropped with a warning
/// (`mimic_ignored`). @throws InputError for a wrong `<mimic>` of an overlay
void check_mimics(RobotDescription* robot);

/// Checks the friction dimensions of joints that cannot be folded with others, since both links
/// have mass or are the ground.
/// @throws InputError as check_friction_geometry().
void check_friction(const RobotDescription& robot);

}  // namespace codesign
