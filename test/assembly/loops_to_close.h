// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "assembly/posture.h"
#include "assembly/start_design.h"
#include "assembly/tree_loops.h"
#include "equations/compiled.h"

namespace codesign {

/// Two links, of length 1 and `length` (the right one), on ground hinges `distance` apart; a loop
/// joins their tips. With 1.2 they meet below or above the middle, at angles whose sine is 0.6.
inline std::string triangle(const std::string& distance = "1.2") {
  return "<robot name='t' xmlns:codesign='urn:t'><codesign:parameter name='length' value='1' "
         "lower='0.5' upper='2'/><link name='ground'/>" +
         bar("left") + bar("right") + hinge("left_hinge", "ground", "left", "0 0 0") +
         hinge("right_hinge", "ground", "right", distance + " 0 0") +
         "<loop name='tip' type='continuous'><predecessor link='left'><origin xyz='0 0 "
         "-1'/></predecessor>"
         "<successor link='right'><origin xyz='0 0 -1' codesign:xyz='0 0 "
         "${-length}'/></successor><axis xyz='0 1 0'/></loop></robot>";
}

/// Three bars in a line, 0.1 longer than the gap that they bridge.
inline std::string stretched_bars() {
  return robot(
      bar("one") + bar("two") + bar("three") + hinge("h1", "ground", "one", "0 0 0") +
      hinge("h2", "one", "two", "0 0 -1") + hinge("h3", "two", "three", "0 0 -1") +
      "<loop name='end' type='continuous'><predecessor link='three'><origin xyz='0 0 "
      "-1'/></predecessor>"
      "<successor link='ground'><origin xyz='0 0 -2.9'/></successor><axis xyz='0 1 0'/></loop>");
}

/// Of the triangle, whose loop has this row not enforced.
inline ReactionSharing without_row(int row) {
  ReactionSharing sharing;
  sharing.compliance = 1e-9;
  sharing.pairs = {2};
  sharing.dropped = {{2, -1, row}};
  return sharing;
}

/// A mechanism at its study's design, whose loops are not closed yet.
struct LoopsToClose {
  Compiled compiled;
  TreeLoops loops;
  std::vector<double> parameters;
  StartDesign design;

  /// @param initial the `initial_state` mapping. @param more of the study.
  explicit LoopsToClose(const std::string& urdf, const std::string& initial = "{}",
                        const ReactionSharing& sharing = 1e-9,
                        const std::string& more = "duration: 1.0\n")
      : compiled(urdf, more + "initial_state: " + initial + "\n", sharing),
        loops(compiled.system),
        parameters(compiled.system.parameters()),
        design{parameters, &compiled.equations} {
    compiled.equations.set_design(parameters);
  }
  /// At rest at these coordinates [rad or m].
  Posture at(const std::vector<double>& theta) const {
    Posture posture;
    posture.theta = Eigen::Map<const Eigen::VectorXd>(theta.data(), to_signed(theta.size()));
    posture.rate = VectorX<double>::Zero(posture.theta.size());
    posture.given = loops.given;
    return posture;
  }
};

}  // namespace codesign
