// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/loop_plane.h"

#include <algorithm>
#include <cmath>

#include "math/arrays.h"
#include "mechanism/constants.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Vector = Vector3<double>;
constexpr double kPlanar = 1e-3;  // [rad and m] as the default of solver.closure_tolerance

/// The angle between two vectors, 0 ... pi [rad].
double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The angle between two lines, 0 ... pi/2 [rad].
double angle_of_lines(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

std::string radians(double angle) { return to_decimal(angle) + " rad"; }

/// How a joint with this axis moves out of the plane with this normal; empty if it does not.
PlaneFault joint_fault(const JointDescription& joint, const Vector& axis, const Vector& normal) {
  const std::string name = (joint.is_loop ? "the loop" : "joint '" + joint.name + "'");
  const double angle = angle_of_lines(axis, normal);
  if (joint.law().turns_in_plane()) {
    if (angle <= kPlanar) return {};
    return {name + " turns about an axis that is not normal to the plane", radians(angle)};
  }
  if (joint.is_slide()) {
    if (M_PI / 2.0 - angle <= kPlanar) return {};
    return {name + " slides along an axis that is not in the plane", radians(M_PI / 2.0 - angle)};
  }
  if (joint.is_loop) return {};  // fixed
  return {name + " is of a type that moves out of the plane", ""};
}

/// By how much the loop misses itself across its plane, once around.
PlaneFault gap_across(const Pose<double>& around, const Vector& normal) {
  const double angle = angle_between(normal, around.R * normal),
               gap = std::abs(normal.dot(around.t));
  if (angle > kPlanar)
    return {"the normals of the plane at predecessor and successor differ", radians(angle)};
  if (gap > kPlanar)
    return {"predecessor and successor are apart along the normal of the plane",
            to_decimal(1e3 * gap) + " mm"};
  return {};
}

/// Friction of a slide adds the forces along x'' and y'', which are along the plane and normal to
/// it, in either order.
PlaneFault transverse_fault(const JointDescription& loop, const Pose<double>& frame,
                            const Vector& axis, const Vector& normal) {
  if (!loop.is_slide() || !loop.friction || !loop.friction->transverse_axis) return {};
  const Vector x =
      frame.R * transverse_axis<double>(frame.R.transpose() * axis, loop.friction->transverse_axis);
  const double angle = angle_of_lines(x, normal), off = std::min(angle, M_PI / 2.0 - angle);
  if (off <= kPlanar) return {};
  return {"transverse_axis of its friction is neither in the plane nor normal to it", radians(off)};
}

}  // namespace

std::vector<ChainElement> joints_around(const RobotDescription& robot,
                                        const std::vector<int>& link_parent_joint, int loop) {
  const JointDescription& description = robot.joints[to_index(loop)];
  const std::vector<int> above = links_above(robot, link_parent_joint, description.parent);
  std::vector<ChainElement> up, down;
  for (int joint :
       joints_between(robot, link_parent_joint, description.parent, description.child)) {
    const int child = robot.joints[to_index(joint)].child;
    const bool rises = std::find(above.begin(), above.end(), child) != above.end();
    (rises ? up : down).push_back({joint, rises});
  }
  up.insert(up.end(), down.rbegin(), down.rend());
  up.push_back({loop, true});
  return up;
}

PlaneFault find_plane_fault(const RobotDescription& robot, const Topology& topology,
                            const Pair& pair, const std::vector<double>& parameters) {
  const auto joint = [&robot](const ChainElement& element) -> const JointDescription& {
    return robot.joints[to_index(element.joint)];
  };
  const bool turns = std::any_of(
      pair.around.begin(), pair.around.end(),
      [&](const ChainElement& element) { return joint(element).law().turns_in_plane(); });
  if (!turns)
    return {"no joint around it turns, so that its turn in a plane is redundant, too", ""};
  const Vector normal = plane_normal(robot, topology, pair, parameters);
  const auto around = chain_geometry(robot, topology, pair.around, parameters);
  for (std::size_t k = 0; k < pair.around.size(); ++k)
    if (PlaneFault fault = joint_fault(joint(pair.around[k]), around.axes[k], normal);
        !fault.message.empty())
      return fault;
  if (PlaneFault fault = gap_across(around.X_ij, normal); !fault.message.empty()) return fault;
  const auto own = chain_geometry(robot, topology, pair.chain, parameters);
  return transverse_fault(joint(pair.chain[0]), own.frames[0], own.axes[0], normal);
}

bool could_be_in_plane(const RobotDescription& robot, const Topology& topology, Pair pair,
                       const std::vector<double>& parameters) {
  if (!pair.is_loop || pair.chain.size() != 1 || !pair.kind->in_plane) return false;
  pair.around = joints_around(robot, topology.link_parent_joint, pair.chain[0].joint);
  return find_plane_fault(robot, topology, pair, parameters).message.empty();
}

void require_planar(const RobotDescription& robot, const Topology& topology, const Pair& pair) {
  const PlaneFault fault = find_plane_fault(robot, topology, pair, default_values(robot));
  if (fault.message.empty()) return;
  const JointDescription& loop = robot.joints[to_index(pair.chain[0].joint)];
  throw InputError({loop.where, loop.element(),
                    "codesign:out_of_plane is zero, but the loop is not planar: " + fault.message,
                    fault.value,
                    "at most 0.001 rad and 1 mm; or codesign:out_of_plane=\"shared\""});
}

}  // namespace codesign
