// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/near_links.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "problem/load_problem.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

constexpr double kNear = 0.1;  // of the smaller link's size

using Bodies = std::pair<int, int>;

Bodies ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// The pairs of bodies that something connects.
std::set<Bodies> connected_bodies(const CompiledSystem& system) {
  const RobotDescription& robot = system.robot();
  const std::vector<int>& body = system.topology().link_body;
  std::set<Bodies> connected;
  for (const Pair& pair : system.topology().pairs)
    connected.insert(ordered(pair.body_i, pair.body_j));
  for (const ContactDescription& contact : robot.contacts)
    connected.insert(
        ordered(body[to_index(contact.surface.link)], body[to_index(contact.points.link)]));
  return connected;
}

double size_of(const std::vector<SolidBox>& boxes) {
  double size = 0.0;
  for (const SolidBox& box : boxes) size = std::max(size, 2.0 * box.half.norm());
  return size;
}

std::vector<SolidBox> placed(std::vector<SolidBox> boxes, const LinkSample& link) {
  for (SolidBox& box : boxes)
    box.pose = Eigen::Translation3d(link.position) * link.orientation * box.pose;
  return boxes;
}

}  // namespace

double box_distance(const SolidBox& a, const SolidBox& b) {
  const Eigen::Matrix3d A = a.pose.linear(), B = b.pose.linear();
  const Eigen::Vector3d between = b.pose.translation() - a.pose.translation();
  double distance = 0.0;
  const auto look_along = [&](const Eigen::Vector3d& axis) {
    if (axis.norm() < 1e-9) return;
    const Eigen::Vector3d n = axis.normalized();
    const double reach =
        a.half.dot((A.transpose() * n).cwiseAbs()) + b.half.dot((B.transpose() * n).cwiseAbs());
    distance = std::max(distance, std::abs(n.dot(between)) - reach);
  };
  for (int i = 0; i < 3; ++i) {
    look_along(A.col(i));
    look_along(B.col(i));
    for (int k = 0; k < 3; ++k) look_along(A.col(i).cross(B.col(k)));
  }
  return distance;
}

std::vector<NearLinks> find_near_links(const Problem& problem,
                                       const std::vector<double>& parameters,
                                       const std::vector<std::string>& links, const Frame& frame) {
  const CompiledSystem& system = *system_of(problem);
  const RobotDescription& robot = robot_of(problem);
  LinkBoxes boxes = link_boxes(
      write_tuned_urdf(problem.urdf(), problem.overlays(), parameters, std::nullopt, robot.laws),
      links, "collision");
  std::vector<int> body(links.size(), Topology::kMassless);
  for (std::size_t k = 0; k < links.size(); ++k) {
    boxes[k] = placed(boxes[k], frame.links[k]);
    for (std::size_t link = 0; link < robot.links.size(); ++link)
      if (robot.links[link].name == links[k]) body[k] = system.topology().link_body[link];
  }
  const std::set<Bodies> connected = connected_bodies(system);
  std::map<Bodies, std::size_t> told;  // where in `near`
  std::vector<NearLinks> near;
  for (std::size_t a = 0; a < links.size(); ++a)
    for (std::size_t b = a + 1; b < links.size(); ++b) {
      if (boxes[a].empty() || boxes[b].empty() || body[a] == body[b]) continue;
      if (body[a] == Topology::kMassless || body[b] == Topology::kMassless) continue;
      double distance = std::numeric_limits<double>::infinity();
      for (const SolidBox& of_a : boxes[a])
        for (const SolidBox& of_b : boxes[b])
          distance = std::min(distance, box_distance(of_a, of_b));
      if (distance > kNear * std::min(size_of(boxes[a]), size_of(boxes[b]))) continue;
      const Bodies bodies = ordered(body[a], body[b]);
      if (connected.count(bodies) != 0) continue;
      const auto [at, is_first] = told.insert({bodies, near.size()});
      if (is_first)
        near.push_back({links[a], links[b], distance});
      else if (distance < near[at->second].distance)
        near[at->second] = {links[a], links[b], distance};
    }
  return near;
}

}  // namespace codesign
