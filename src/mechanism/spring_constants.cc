// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/spring_constants.h"

#include <cmath>

#include "codegen/number_types.h"
#include "math/arrays.h"
#include "mechanism/pose.h"

namespace codesign {

template <class T>
SpringDamperConstants<T> link_element_constants(const RobotDescription& robot,
                                                const Topology& topology,
                                                const SpringDamperDescription& spring,
                                                const LinkFrames<T>& links,
                                                const std::vector<T>& parameters) {
  SpringDamperConstants<T> result;
  const auto attach = [&](int link, const PoseDescription& origin, int* body, Vector3<T>* s) {
    *body = topology.link_body[to_index(link)];
    if (*body == Topology::kMassless)
      throw InputError({spring.where, "<codesign:spring_damper name=\"" + spring.name + "\">",
                        "a spring cannot pull on a link without <inertial>",
                        robot.links[to_index(link)].name, "a link with an <inertial>"});
    *s = links[to_index(link)].R * vector_at(origin.xyz, parameters) + links[to_index(link)].s;
  };
  attach(spring.predecessor, spring.predecessor_origin, &result.body_i, &result.s_i);
  attach(spring.successor, spring.successor_origin, &result.body_j, &result.s_j);
  result.stiffness = spring.stiffness.at(parameters);
  result.damping = spring.damping.at(parameters);
  result.free_length = spring.free_length.at(parameters);
  return result;
}

#define CODESIGN_INSTANTIATE(T)                                                 \
  template SpringDamperConstants<T> link_element_constants<T>(                  \
      const RobotDescription&, const Topology&, const SpringDamperDescription&, \
      const LinkFrames<T>&, const std::vector<T>&);
CODESIGN_FOR_EACH_FORMULA_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

std::string link_element_fault(const SpringDamperDescription& spring,
                               const SpringDamperConstants<double>& c) {
  return std::isfinite(c.stiffness + c.damping + c.free_length)
             ? ""
             : "spring-damper '" + spring.name + "' is not finite";
}

}  // namespace codesign
