// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>
#include <string>
#include <vector>

#include "reading/study/entry_keys.h"
#include "reading/study/study_options.h"
#include "reading/study/study_values.h"

namespace codesign {
namespace {

constexpr double kMostPoints = 1e6;

using LimitKeys = EntryKeys<MotionLimitDescription, NoContext>;
using JointKeys = EntryKeys<ExcitedJoint, NoContext>;

void read_position_limits(const YamlValue& value, const NoContext&,
                          MotionLimitDescription* limits) {
  const std::vector<YamlValue> ends = value.items();
  if (ends.size() != 2)
    value.fail("a range of positions has two ends, found " + std::to_string(ends.size()),
               "[lower, upper]");
  limits->position = {ends[0].number(), ends[1].number()};
  if (!((*limits->position)[0] < (*limits->position)[1]))
    value.fail("the range is empty", "lower below upper");
}

EntryKey<MotionLimitDescription, NoContext> magnitude_key(
    const char* name, std::optional<double> MotionLimitDescription::*member) {
  return {name, false,
          [member](const YamlValue& value, const NoContext&, MotionLimitDescription* of) {
            of->*member = read_above_zero(value);
          }};
}

const LimitKeys& follower_keys() {
  static const LimitKeys kKeys{{"position", false, read_position_limits},
                               magnitude_key("velocity", &MotionLimitDescription::velocity)};
  return kKeys;
}

const JointKeys& joint_keys() {
  using Limits = MotionLimitDescription;
  static const JointKeys kKeys = with(
      of_member(
          with(follower_keys(), LimitKeys{magnitude_key("acceleration", &Limits::acceleration),
                                          magnitude_key("effort", &Limits::effort)}),
          &ExcitedJoint::limits),
      JointKeys{{"noise", false, [](const YamlValue& value, const NoContext&, ExcitedJoint* of) {
                   of->noise = read_above_zero(value);
                 }}});
  return kKeys;
}

/// The limits of a joint, of which none is read yet.
MotionLimitDescription limits_of(const std::string& name, const YamlValue& value,
                                 const RobotDescription& robot) {
  MotionLimitDescription limits;
  limits.joint = scalar_joint(name, robot, value).name;
  limits.element = value.path();
  limits.where = value.where();
  return limits;
}

/// @param noise of all joints; 0: each joint has its own.
ExcitedJoint read_joint(const std::string& name, const YamlValue& value,
                        const RobotDescription& robot, double noise) {
  require_keys(value, joint_keys());
  ExcitedJoint joint{limits_of(name, value, robot), noise};
  read_entry(value, joint_keys(), {}, &joint);
  if (joint.noise == 0.0)
    value.fail("how noisy the efforts are is not known",
               "noise: standard deviation of one sample [N m or N], here or as excite.noise");
  return joint;
}

void read_joints(const YamlValue& excite, const RobotDescription& robot,
                 ExcitationDescription* description) {
  const auto noise = excite.find("noise");
  const double of_all = noise ? read_above_zero(*noise) : 0.0;
  const YamlValue joints = excite.at("joints");
  for (const auto& [name, value] : joints.entries())
    description->joints.push_back(read_joint(name, value, robot, of_all));
  if (description->joints.empty())
    joints.fail("no joint to move", "the joints that determine the motion");
}

void read_followers(const YamlValue& limits, const RobotDescription& robot,
                    ExcitationDescription* description) {
  for (const auto& [name, value] : limits.entries()) {
    require_keys(value, follower_keys());
    const std::string joint = name;
    if (std::any_of(description->joints.begin(), description->joints.end(),
                    [&](const ExcitedJoint& excited) { return excited.limits.joint == joint; }))
      value.fail("the joint is one of excite.joints",
                 "its limits there, and here those of joints that follow");
    description->followers.push_back(limits_of(name, value, robot));
    read_entry(value, follower_keys(), {}, &description->followers.back());
  }
}

void check_shape(const YamlValue& excite, const ExcitationDescription& description) {
  const bool is_spline = description.trajectory == TrajectoryKind::kSpline;
  if (const auto harmonics = excite.find("harmonics"); harmonics && is_spline)
    harmonics->fail("a spline has no harmonics", "knots, or trajectory: fourier");
  if (const auto knots = excite.find("knots"); knots && !is_spline)
    knots->fail("a Fourier series has no knots", "harmonics, or trajectory: spline");
}

void check_recording_plan(const YamlValue& excite, const ExcitationDescription& description) {
  const double samples = description.period * description.sample_rate;
  const int waves =
      description.trajectory == TrajectoryKind::kSpline ? description.knots : description.harmonics;
  const YamlValue at = excite.find("sample_rate").value_or(excite);
  if (samples < 4.0 * waves)
    at.fail("the samples do not show the trajectory",
            "at least " + std::to_string(4 * waves) + " samples in a period");
  if (samples * description.periods > kMostPoints)
    at.fail("more than a million samples", "a lower rate, or a shorter motion");
}

}  // namespace

std::vector<EntryForm> forms_of_excited_joints() {
  return {{"excite.joints.JOINT", joint_keys()}, {"excite.limits.JOINT", follower_keys()}};
}

ExcitationDescription read_excitation(const YamlValue& excite, const RobotDescription& robot) {
  ExcitationDescription description;
  require_option_keys(excite, description, {"joints"}, {"limits", "noise"});
  description.where = excite.where();
  read_joints(excite, robot, &description);
  if (const auto limits = excite.find("limits")) read_followers(*limits, robot, &description);
  visit_options(OptionReader{excite}, &description);
  check_shape(excite, description);
  check_recording_plan(excite, description);
  return description;
}

}  // namespace codesign
