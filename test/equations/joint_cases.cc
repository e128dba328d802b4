// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/joint_cases.h"

#include <ostream>
#include <string>
#include <vector>

namespace codesign {

void PrintTo(const JointCase& c, std::ostream* out) { *out << c.name; }

namespace joint_cases {

std::string body(const std::string& name) {
  return "<link name='" + name + "'>" + kInertial + "</link>";
}

std::string tree(const std::string& name, const std::string& type, const std::string& parent,
                 const std::string& child, const std::string& axis, const std::string& more) {
  const std::string limit = type == "prismatic" || type == "revolute"
                                ? "<limit lower='-3' upper='3' effort='1' velocity='1'/>"
                                : "";
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/>" +
         (type == "floating" ? "" : "<axis xyz='" + axis + "'/>") + limit + more + "</joint>";
}

std::string loop(const std::string& type, const std::string& predecessor, const std::string& more) {
  return "<loop name='joint' type='" + type + "'><predecessor link='" + predecessor + "'>" +
         (predecessor == "base" ? kOrigin : "") +
         "</predecessor><successor link='tip'><origin xyz='0 -0.3 0.1' codesign:xyz='0 -0.3 "
         "${size}' rpy='0.1 0.5 0'/></successor><axis "
         "xyz='1 0 0.5'/>" +
         more + "</loop>";
}

std::string free(const std::string& link) {
  return tree("free_" + link, "floating", "ground", link, "");
}

std::string chain(const std::vector<std::pair<char, std::string>>& joints) {
  std::string content;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const std::string parent = k == 0 ? "base" : "frame" + std::to_string(k - 1);
    const std::string child = k + 1 == joints.size() ? "tip" : "frame" + std::to_string(k);
    if (child != "tip") content += "<link name='" + child + "'/>";
    content +=
        tree("joint" + std::to_string(k), joints[k].first == 'R' ? "continuous" : "prismatic",
             parent, child, joints[k].second, k == 0 ? kOrigin : "");
  }
  return content;
}

std::string model(const JointCase& c) {
  return robot(
      "<codesign:parameter name='size' value='0.1'/><codesign:parameter name='mass' value='0.8'/>"
      "<codesign:parameter name='ratio' value='1.5'/>" +
      body("base") + body("tip") + free("base") + c.content);
}

std::vector<JointCase> trees() {
  const auto one = [](const std::string& type) {
    return tree("joint", type, "base", "tip", "1 0 0.5", kOrigin);
  };
  const auto of_type = [](const std::string& type) {
    return tree("joint", "floating' codesign:type='" + type, "base", "tip", "1 0 0.5", kOrigin);
  };
  return {{"revolute", one("revolute"), 5},
          {"continuous", one("continuous"), 5},
          {"prismatic", one("prismatic"), 5},
          {"cylindrical", chain({{'R', "0 0 1"}, {'P', "0 0 1"}}), 4},
          {"spherical", chain({{'R', "1 0 0"}, {'R', "0 1 0"}, {'R', "0 0 1"}}), 3},
          {"cylindrical_by_type", of_type("cylindrical"), 4},
          {"spherical_by_type", of_type("spherical"), 3},
          {"universal", chain({{'R', "1 0 0"}, {'R', "0.3 1 0"}}), 4, false},
          {"planar", one("planar"), 3},
          {"table", chain({{'P', "1 0 0"}, {'P', "0.4 1 0"}}), 4},
          {"translational", chain({{'P', "1 0 0"}, {'P', "0.4 1 0"}, {'P', "0 0.2 1"}}), 3, true,
           false},
          {"floating", one("floating"), 0, true, false}};
}

std::vector<JointCase> loops() {
  const auto one = [](const std::string& type, const std::string& more = "") {
    return free("tip") + loop(type, "base", more);
  };
  const std::string stage =
      "<link name='stage'/>" + tree("slide", "prismatic", "base", "stage", "0 1 0", kOrigin);
  return {{"fixed_loop", one("fixed"), 6},
          {"revolute_loop", one("revolute"), 5},
          {"continuous_loop", one("continuous"), 5},
          {"prismatic_loop", one("prismatic"), 5},
          {"cylindrical_loop", one("codesign:cylindrical"), 4},
          {"spherical_loop", one("codesign:spherical"), 3},
          {"universal_loop", one("codesign:universal", "<codesign:second_axis xyz='0.3 1 0'/>"), 4,
           false},
          {"planar_loop", one("planar"), 3},
          {"table_loop", free("tip") + stage + loop("prismatic", "stage"), 4},
          {"distance_loop",
           one("codesign:distance", "<codesign:length value='0.5' codesign:value='${5*size}'/>"), 1,
           false}};
}

std::vector<JointCase> couplings() {
  const std::string middle =
      body("middle") + tree("driver", "continuous", "base", "middle", "0 1 0", kOrigin);
  const std::string mimic =
      "<mimic joint='driver' multiplier='1.5' codesign:multiplier='${ratio}' offset='0.1' "
      "codesign:offset='${size}'/>";
  const std::string coupling =
      "<coupling name='gear'><predecessor link='middle'/><successor link='tip'/><ratio value='1.5' "
      "codesign:value='${ratio}'/></coupling>";
  return {{"mimic", middle + tree("joint", "continuous", "middle", "tip", "1 0 0.5", mimic), 11},
          {"mimic_of_a_slide",
           middle + tree("joint", "prismatic", "middle", "tip", "1 0 0.5", mimic), 11},
          {"coupling",
           middle + tree("joint", "continuous", "base", "tip", "1 0 0.5", kOrigin) + coupling, 11}};
}

std::vector<JointCase> all() {
  std::vector<JointCase> cases = trees();
  for (const std::vector<JointCase>& more : {loops(), couplings()})
    cases.insert(cases.end(), more.begin(), more.end());
  return cases;
}

}  // namespace joint_cases
}  // namespace codesign
