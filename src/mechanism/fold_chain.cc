// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/fold_chain.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/arrays.h"
#include "mechanism/constants.h"
#include "mechanism/pair_geometry.h"
#include "mechanism/topology.h"

namespace codesign {
namespace {

using Vector = Vector3<double>;
constexpr double kParallel = 1e-9;  // tolerance for unit axes to be parallel
// Tolerance for axes to meet: absolute [m], and relative to the chain's size.
constexpr double kConcurrent = 1e-9;

struct Axes {
  std::vector<Vector> turn, turn_point, slide;
};

bool parallel(const Vector& a, const Vector& b) { return a.cross(b).norm() < kParallel; }

bool meet(const Vector& p, const Vector& a, const Vector& q, const Vector& b) {
  const Vector normal = a.cross(b);
  return std::abs((q - p).dot(normal)) < kConcurrent * normal.norm();
}

bool on_line(const Vector& point, const Vector& origin, const Vector& axis) {
  return (point - origin).cross(axis).norm() < kConcurrent;
}

/// Whether all turning axes pass through one point.
bool concurrent(const Axes& axes) {
  const auto& z = axes.turn;
  const auto& o = axes.turn_point;
  for (std::size_t k = 1; k < z.size(); ++k)
    if (parallel(z[k - 1], z[k]) || !meet(o[k - 1], z[k - 1], o[k], z[k])) return false;
  const Vector centre = nearest_point(o[0], z[0], o[1], z[1]);
  for (std::size_t k = 2; k < z.size(); ++k)
    if (!on_line(centre, o[k], z[k])) return false;
  return true;
}

bool independent(const std::vector<Vector>& slide) {
  if (slide.size() == 2) return !parallel(slide[0], slide[1]);
  return slide.size() == 3 && std::abs(slide[0].cross(slide[1]).dot(slide[2])) > kParallel;
}

std::optional<PairKind> fold_axes(const Axes& axes) {
  const std::size_t turns = axes.turn.size(), slides = axes.slide.size();
  if (slides == 0 && turns == 1) return PairKind::kRevolute;
  if (slides == 1 && turns == 0) return PairKind::kPrismatic;
  if (slides == 0 && turns == 2 && concurrent(axes)) return PairKind::kUniversal;
  if (slides == 0 && turns == 3 && concurrent(axes)) return PairKind::kSpherical;
  if (slides == 1 && turns == 1 && parallel(axes.turn[0], axes.slide[0]))
    return PairKind::kCylindrical;
  if (slides == 2 && turns == 0 && independent(axes.slide)) return PairKind::kTable;
  if (slides == 3 && turns == 0 && independent(axes.slide)) return PairKind::kTranslational;
  if (slides == 2 && turns == 1 && independent(axes.slide) &&
      parallel(axes.turn[0], axes.slide[0].cross(axes.slide[1]).normalized()))
    return PairKind::kPlanar;
  if (slides == 3 && turns == 3 && independent(axes.slide) && concurrent(axes))
    return PairKind::kFree;
  return std::nullopt;
}

[[noreturn]] void refuse(const RobotDescription& robot, const std::vector<ChainElement>& chain) {
  std::string names;
  for (const ChainElement& element : chain)
    names += (names.empty() ? "" : ", ") + robot.joints[to_index(element.joint)].name;
  const JointDescription& joint = robot.joints[to_index(chain.front().joint)];
  throw InputError({joint.where, joint.element(),
                    "a chain of links without <inertial> that cannot be folded into one joint",
                    names,
                    "concurrent revolutes (universal, spherical), a coaxial revolute and "
                    "prismatic, two or three prismatics, two prismatics with a "
                    "revolute normal to them; or give the links an <inertial>"});
}

std::optional<PairKind> kind_of_chain(const RobotDescription& robot, const Topology& topology,
                                      const std::vector<ChainElement>& chain) {
  const ChainGeometry<double> geometry =
      chain_geometry(robot, topology, chain, default_values(robot));
  Axes axes;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const JointDescription& joint = robot.joints[to_index(chain[k].joint)];
    if (joint.is_turn()) {
      axes.turn.push_back(geometry.axes[k]);
      axes.turn_point.push_back(geometry.frames[k].t);
    } else if (joint.is_slide()) {
      axes.slide.push_back(geometry.axes[k]);
    } else {
      return std::nullopt;
    }
  }
  return fold_axes(axes);
}

bool needs_coordinate(const RobotDescription& robot, const Topology& topology, int k) {
  const JointDescription& joint = robot.joints[to_index(k)];
  if (!joint.damping.is_zero() || !joint.dry_friction.is_zero() || joint.spring || joint.actuator ||
      joint.mimic || !joint.armature.is_zero())
    return true;
  for (const JointDescription& other : robot.joints)
    if (other.mimic && other.mimic->joint == joint.name) return true;
  if (joint.is_play) return false;
  for (const CouplingDescription& coupling : robot.couplings) {
    const std::vector<int> coupled =
        joints_between(robot, topology.link_parent_joint, coupling.predecessor, coupling.successor);
    if (std::find(coupled.begin(), coupled.end(), k) != coupled.end()) return true;
  }
  return false;
}

}  // namespace

PairKind fold_chain(const RobotDescription& robot, const Topology& topology,
                    const std::vector<ChainElement>& chain) {
  const auto kind = chain.size() == 1 ? kind_of(robot.joints[to_index(chain[0].joint)])
                                      : kind_of_chain(robot, topology, chain);
  if (!kind) refuse(robot, chain);
  return *kind;
}

bool folds(const RobotDescription& robot, const Topology& topology,
           const std::vector<ChainElement>& chain) {
  const std::optional<PairKind> kind = kind_of_chain(robot, topology, chain);
  if (!kind) return false;
  Pair pair;
  pair.kind = *kind;
  pair.chain = chain;
  const Vector none = Vector::Zero();
  const PairConstants<double> constants =
      pair_constants(robot, topology, pair, none, none, default_values(robot));
  for (std::size_t k = 0; k < chain.size(); ++k)
    if (constants.coordinates[k].kind == CoordinateConstants<double>::Kind::kNone &&
        needs_coordinate(robot, topology, chain[k].joint))
      return false;
  return true;
}

}  // namespace codesign
