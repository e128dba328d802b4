// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/transmission_reader.h"

#include <algorithm>
#include <cmath>

#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kGearRatio = "<codesign:actuator gear_ratio=\"...\">, which makes the transmission irrelevant";

/// The type of a transmission: `<type>NAME</type>`, or the attribute `type` as in PR2's files.
std::string type_of(const XmlElement& transmission) {
  const std::vector<XmlElement> types = transmission.children("type");
  const char* const text = types.empty() ? nullptr : types.front().node()->GetText();
  return text != nullptr ? text : transmission.find("type").value_or("");
}

bool is_simple(const XmlElement& transmission) {
  return ends_with(type_of(transmission), "SimpleTransmission") && transmission.children("joint").size() == 1 &&
         transmission.children("actuator").size() <= 1;
}

/// The reductions of a transmission in order of preference: of `<actuator>`, where ros_control reads it, of `<joint>`, then its own.
std::vector<XmlElement> reductions(const XmlElement& transmission) {
  std::vector<XmlElement> found;
  for (const char* tag : {"actuator", "joint"})
    for (const XmlElement& part : transmission.children(tag))
      for (const XmlElement& reduction : part.children("mechanicalReduction")) found.push_back(reduction);
  for (const XmlElement& reduction : transmission.children("mechanicalReduction")) found.push_back(reduction);
  return found;
}

class TransmissionReader {
 public:
  TransmissionReader(const XmlElement& element, RobotDescription* robot)
      : robot_(robot), transmissions_(element.children("transmission")) {}

  void read(JointDescription* joint) {
    std::optional<double> ratio;
    for (const XmlElement& transmission : transmissions_) {
      const std::vector<XmlElement> joints = transmission.children("joint");
      if (std::none_of(joints.begin(), joints.end(), [&](const XmlElement& j) { return j.find("name") == joint->name; })) continue;
      const std::vector<XmlElement> found = reductions(transmission);
      if (!is_simple(transmission)) {
        if (!found.empty())
          doubt("transmission_not_simple", transmission, type_of(transmission),
                "its reduction is not taken as the gear ratio of joint \"" + joint->name + "\"");
        continue;
      }
      for (const XmlElement& reduction : found) take(reduction, *joint, &ratio);
    }
    if (ratio) joint->actuator->gear_ratio = *ratio;
  }

 private:
  void take(const XmlElement& reduction, const JointDescription& joint, std::optional<double>* ratio) {
    const char* const text = reduction.node()->GetText();
    const std::vector<std::string> words = split_words(text != nullptr ? text : "");
    const std::optional<double> number = words.size() == 1 ? parse_number(words[0]) : std::nullopt;
    if (!number || !std::isfinite(*number) || *number == 0.0) {
      doubt("transmission_not_read", reduction, text != nullptr ? text : "",
            "the reduction is not a finite number other than zero and is ignored");
    } else if (!*ratio) {
      *ratio = *number;
    } else if (**ratio != *number) {
      doubt("transmission_contradicts", reduction, text,
            "joint \"" + joint.name + "\" already has the reduction " + to_decimal(**ratio) + "; this one is ignored");
    }
  }

  void doubt(const char* code, const XmlElement& at, const std::string& value, const std::string& message) {
    robot_->warnings.push_back(warn(code, {at.where(), at.label(), message, value, kGearRatio}));
  }

  RobotDescription* robot_;
  std::vector<XmlElement> transmissions_;
};

}  // namespace

void read_transmissions(const XmlElement& element, RobotDescription* robot) {
  TransmissionReader reader(element, robot);
  for (const XmlElement& joint : element.children("joint")) {
    const std::optional<XmlElement> actuator = joint.child("codesign:actuator");
    if (!actuator || actuator->has("gear_ratio")) continue;
    for (JointDescription& description : robot->joints)
      if (!description.is_loop && description.name == joint.find("name") && description.actuator) reader.read(&description);
  }
}

}  // namespace codesign
