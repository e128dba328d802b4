// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/watched_cases.h"

#include <string>
#include <vector>

namespace codesign {

GradientCase with_watched(GradientCase test) {
  std::vector<std::string> texts = default_signals(test.robot, test.study.controllers);
  if (texts.size() > 8) texts.resize(8);
  for (const JointDescription& joint : test.robot.joints)
    if (joint.type == JointType::kRevolute || joint.type == JointType::kContinuous) {
      texts.push_back(joint.name + "/acceleration");
      break;
    }
  bool peak = false;
  for (const std::string& text : texts) {
    WatchedSignal& watched = test.study.watched.emplace_back();
    watched.role = peak ? WatchedSignal::Role::kPeak : WatchedSignal::Role::kPath;
    watched.signal = parse_signal(text, {}, "signal");
    watched.upper = Quantity(1.0);
    watched.after = 0.1 * test.study.duration;
    watched.before = 0.95 * test.study.duration;
    peak = !peak;
  }
  return test;
}

}  // namespace codesign
