// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/vocabulary.h"

#include <algorithm>

namespace codesign {
namespace {

using Words = std::vector<Vocabulary>;

void add_shape(const std::string& path, Words* words) {
  words->push_back({path + "/origin", {"xyz", "rpy"}, {}, {"quat_xyzw"}, {}, false});
  words->push_back({path + "/geometry",
                    {},
                    {"box", "cylinder", "sphere", "mesh"},
                    {},
                    {"capsule", "plane", "ellipsoid", "superellipsoid", "heightmap", "convex",
                     "cone", "cdf", "image"},
                    false});
  words->push_back({path + "/geometry/box", {"size"}, {}, {}, {}, false});
  words->push_back({path + "/geometry/cylinder", {"radius", "length"}, {}, {}, {}, false});
  words->push_back({path + "/geometry/sphere", {"radius"}, {}, {}, {}, false});
  words->push_back({path + "/geometry/mesh", {"filename", "scale"}, {}, {}, {}, false});
}

void add_material(const std::string& path, Words* words) {
  words->push_back({path, {"name"}, {"color", "texture"}, {}, {}, false});
  words->push_back({path + "/color", {"rgba"}, {}, {}, {}, false});
  words->push_back({path + "/texture", {"filename"}, {}, {}, {}, false});
}

void add_link(Words* words) {
  const std::string link = "robot/link";
  words->push_back(
      {link,
       {"name"},
       {"inertial", "visual", "collision"},
       {"type", "concave"},
       {"contact", "sensor", "self_collision_checking", "self_collide", "verbose", "audio_source"},
       true});
  words->push_back({link + "/inertial", {}, {"origin", "mass", "inertia"}, {}, {}, false});
  words->push_back({link + "/inertial/origin", {"xyz", "rpy"}, {}, {"quat_xyzw"}, {}, false});
  words->push_back({link + "/inertial/mass", {"value"}, {}, {}, {}, false});
  words->push_back({link + "/inertial/inertia",
                    {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"},
                    {},
                    {},
                    {},
                    false,
                    {{"iyx", "ixy"}, {"izx", "ixz"}, {"izy", "iyz"}}});
  words->push_back({link + "/visual",
                    {"name"},
                    {"origin", "geometry", "material"},
                    {"cast_shadows"},
                    {"meta", "transparency"},
                    false});
  words->push_back({link + "/collision",
                    {"name"},
                    {"origin", "geometry"},
                    {"group", "concave"},
                    {"material", "verbose", "contact_coefficients", "surface", "max_contacts"},
                    false});
  add_shape(link + "/visual", words);
  add_shape(link + "/collision", words);
  add_material(link + "/visual/material", words);
}

void add_joint(Words* words) {
  const std::string joint = "robot/joint";
  words->push_back({joint,
                    {"name", "type"},
                    {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic",
                     "calibration", "safety_controller"},
                    {"independent", "dont_collapse"},
                    {"joint_properties", "hardwareInterface", "actuator", "sensor", "compliance"},
                    false});
  words->push_back({joint + "/origin", {"xyz", "rpy"}, {}, {"quat_xyzw"}, {}, false});
  words->push_back({joint + "/parent", {"link"}, {}, {}, {}, false});
  words->push_back({joint + "/child", {"link"}, {}, {}, {}, false});
  words->push_back({joint + "/axis", {"xyz"}, {}, {}, {}, false});
  words->push_back({joint + "/limit",
                    {"lower", "upper", "effort", "velocity"},
                    {},
                    {"acceleration", "deceleration", "jerk"},
                    {},
                    false});
  words->push_back({joint + "/dynamics",
                    {"damping", "friction", "armature"},
                    {},
                    {"coulomb_window"},
                    {},
                    false});
  words->push_back({joint + "/mimic", {"joint", "multiplier", "offset"}, {}, {}, {}, false});
  words->push_back(
      {joint + "/calibration", {"rising", "falling", "reference_position"}, {}, {}, {}, false});
  words->push_back({joint + "/safety_controller",
                    {"soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"},
                    {},
                    {},
                    {},
                    false});
}

Words make_words() {
  Words words;
  words.push_back(
      {"robot",
       {"name", "version"},
       {"link", "joint", "material", "loop", "coupling", "constraint"},
       {"xmlns"},
       {"transmission", "gazebo", "sensor", "mujoco", "loop_joint", "self_collision_checking"},
       true});
  add_material("robot/material", &words);
  add_link(&words);
  add_joint(&words);
  return words;
}

const Words& all_words() {
  static const Words kWords = make_words();
  return kWords;
}

}  // namespace

const Vocabulary* find_vocabulary(const std::string& path) {
  static const auto kByPath = by_path(all_words());
  const auto found = kByPath.find(path);
  return found != kByPath.end() ? found->second : nullptr;
}

std::vector<std::string> elements_with(const std::string& child) {
  std::vector<std::string> elements;
  for (const Vocabulary& words : all_words()) {
    if (std::find(words.children.begin(), words.children.end(), child) == words.children.end())
      continue;
    const std::string element = "<" + words.path.substr(words.path.rfind('/') + 1) + ">";
    if (std::find(elements.begin(), elements.end(), element) == elements.end())
      elements.push_back(element);
  }
  return elements;
}

}  // namespace codesign
