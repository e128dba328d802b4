// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml2.h>
#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace codesign {

// Lenient reading of plain URDF, for pictures: a missing attribute, or one that is not a number, is
// zero.

/// One number of an attribute.
double plain_number(const tinyxml2::XMLElement* element, const char* attribute);

/// Three numbers of an attribute. @param element may be null.
Eigen::Vector3d plain_vector(const tinyxml2::XMLElement* element, const char* attribute);

/// The child `<origin>` of an element, or the element itself if it has `xyz` or `rpy`: angles in
/// radians about fixed axes x, y, z.
Eigen::Isometry3d plain_origin(const tinyxml2::XMLElement* element);

/// The box around a solid.
struct SolidBox {
  /// axes of the box, with the origin in its centre, in the frame of its link
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  ///< half of its sides [m]
};

/// The boxes of the solids of each link.
using LinkBoxes = std::vector<std::vector<SolidBox>>;

/// The boxes around the `<visual>` or `<collision>` elements of a URDF whose numbers are at their
/// values, as write_tuned_urdf() makes it.
/// @param links names; the result has one entry for each, in their order. A link without solids has
/// no boxes, nor has a mesh, whose size is not known. @param tag `visual` or `collision`.
/// @returns entries without boxes if the text cannot be read: this serves pictures and advice only.
LinkBoxes link_boxes(const std::string& urdf, const std::vector<std::string>& links,
                     const char* tag = "visual");

/// A file of a package of ROS.
struct PackageFile {
  std::string package, inside;
};

/// Tells which meshes a viewer on this machine can load. A package of ROS is a folder of its name
/// at most three levels below an entry of ROS_PACKAGE_PATH, or the entry itself.
class MeshFinder {
 public:
  /// @param uri the filename of a `<mesh>`. Without a scheme (`package://`, `file://`) viewers do
  /// not find it. What is on a network counts as there.
  bool is_there(const std::string& uri);
  /// The file of a mesh, for programs that read it; empty if it is not here. Besides the above, a
  /// package may be a folder above the model or beside one of those, and a path without a scheme
  /// begins in the folder of the model.
  /// @param model the path of the URDF.
  std::filesystem::path find(const std::string& uri, const std::string& model);

 private:
  const std::filesystem::path& folder_of(const std::string& package);
  std::filesystem::path in_package(const PackageFile& file);

  std::map<std::string, std::filesystem::path> folders_;  ///< of packages; empty: not found
};

/// A URDF for viewers: links without `<visual>`, or of whose visuals MeshFinder finds no mesh, get
/// some, named `stick`, so that the mechanism can be seen.
///
/// A link with mass gets a sphere at its joint, or a box if it slides there, and sticks from there
/// to the frames of the joints and loops below it; a link without joints below it gets a stick to
/// its centre of mass and a sphere there. A massless link gets only sticks. The sticks of the root
/// connect the frames of its joints. Sticks are as thick as 4 % of the longest link.
/// @param urdf numbers at their values, as write_tuned_urdf() makes it. @returns the same text, to
/// the letter, if each link has a visual or nothing to draw, or if it is no XML.
std::string with_sticks(const std::string& urdf);

}  // namespace codesign
