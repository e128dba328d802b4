// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/continuation.h"

#include "assembly/assembly.h"
#include "integration/integrator.h"
#include "mechanism/constants.h"

namespace codesign {
namespace {

bool same_pair(const PairConstants<double>& a, const PairConstants<double>& b) {
  return a.s_i == b.s_i && a.s_j == b.s_j && a.C_i == b.C_i && a.C_j == b.C_j &&
         a.cosine == b.cosine && a.distance == b.distance;
}

/// Whether the same coordinates of the bodies mean the same positions of the joints.
bool same_geometry(const Constants<double>& a, const Constants<double>& b) {
  for (std::size_t k = 0; k < a.bodies.size(); ++k)
    if (a.bodies[k].centre != b.bodies[k].centre) return false;
  for (std::size_t k = 0; k < a.pairs.size(); ++k)
    if (!same_pair(a.pairs[k], b.pairs[k])) return false;
  for (std::size_t k = 0; k < a.links.size(); ++k)
    if (a.links[k].s != b.links[k].s || a.links[k].R != b.links[k].R) return false;
  for (std::size_t k = 0; k < a.couplings.size(); ++k)
    if (a.couplings[k].coefficients != b.couplings[k].coefficients ||
        a.couplings[k].offset != b.couplings[k].offset)
      return false;
  return true;
}

}  // namespace

Status Continuation::change_design(const std::vector<double>& parameters, Assembly* assembly,
                                   Equations<double>* equations, State<double>* state) {
  TreeCoordinates from;
  const std::string unknown =
      tree_coordinates(system_, assembly->tree(), *state, assembly->theta(), equations, &from);
  const Constants<double> before = equations->constants();
  equations->set_design(parameters);
  Status status = check_design(system_, *equations);
  status.time = state->t;
  if (!status.ok() || same_geometry(before, equations->constants())) return status;
  if (!unknown.empty())
    return {StatusCode::kAssemblyFailed, state->t,
            "dimensions cannot change here: the position of joint '" + unknown + "' is not known"};
  return assembly->solve_from(from, parameters, equations, state);
}

Status Continuation::cross(const std::vector<double>& parameters, bool interpolated,
                           Assembly* assembly, Equations<double>* equations, State<double>* state) {
  if (interpolated) {
    if (!projection_) projection_ = std::make_unique<Projection>(system_);
    if (!projection_->apply(equations, state))
      return {StatusCode::kSingularMatrix, state->t,
              "the augmented matrix of the equations of motion is singular"};
    equations->track_turns(state);
  }
  const std::vector<double> before = equations->parameters();
  const bool changes = parameters != before;
  Status status = changes ? change_design(parameters, assembly, equations, state) : Status();
  if (status.ok()) status = assembly->rates().solve(equations, state);
  if (!status.ok() && changes) equations->set_design(before);
  return status;
}

}  // namespace codesign
