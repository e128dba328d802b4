// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_loads.h"

#include "reading/study/study_values.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

void read_effort(const YamlValue& value, const RobotDescription& robot, const ParameterTable& table, LoadDescription* load) {
  value.require_keys({"joint", "effort"}, {});
  const YamlValue joint = value.at("joint");
  load->joint = scalar_joint(joint.text(), robot, joint).name;
  load->effort = read_quantity(value.at("effort"), table);
}

void read_wrench(const YamlValue& value, const RobotDescription& robot, const ParameterTable& table, LoadDescription* load) {
  value.require_keys({"link"}, {"force", "torque", "point", "frame"});
  const YamlValue link = value.at("link");
  std::vector<std::string> known;
  for (const LinkDescription& description : robot.links) known.push_back(description.name);
  load->link = link.choice("link", known);
  const auto force = value.find("force"), torque = value.find("torque"), point = value.find("point"), frame = value.find("frame");
  if (!force && !torque) value.fail("a load on a link needs a force or a torque", "force: [x, y, z], torque: [x, y, z]");
  if (point && !force) point->fail("a point without a force has no meaning: it is where the force acts", "force: [x, y, z]");
  if (force) load->force = read_vector(*force, table);
  if (torque) load->torque = read_vector(*torque, table);
  if (point) load->point = read_vector(*point, table);
  if (frame) load->in_link_frame = frame->choice("frame", {"root", "link"}) == "link";
}

}  // namespace

void read_loads(const YamlValue& study_value, const RobotDescription& robot, const ParameterTable& table, Study* study) {
  const auto loads = study_value.find("loads");
  if (!loads) return;
  for (const YamlValue& value : loads->items()) {
    LoadDescription load;
    load.where = value.where();
    if (!value.is_map()) value.fail("a load must be a map", "{joint: NAME, effort: Q} or {link: NAME, force: [x, y, z]}");
    const bool on_joint = value.find("joint").has_value(), on_link = value.find("link").has_value();
    if (on_joint == on_link)
      value.fail("a load acts on one joint or on one link", "{joint: NAME, effort: Q} or {link: NAME, force: [x, y, z]}");
    on_joint ? read_effort(value, robot, table, &load) : read_wrench(value, robot, table, &load);
    study->loads.push_back(load);
  }
}

}  // namespace codesign
