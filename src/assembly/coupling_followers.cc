// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/coupling_followers.h"

#include "assembly/posture.h"
#include "equations/equations.h"
#include "equations/formulas.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "system/system.h"

namespace codesign {

CouplingFollowers::CouplingFollowers(const System& system, const TreeLayout& tree)
    : system_(system), tree_(tree), follows_(to_index(tree.size), false) {
  const Topology& topology = system.topology();
  for (const Coupling& coupling : topology.couplings) {
    const CouplingTerm& first = coupling.terms.front();
    const bool in_tree = !topology.pairs[to_index(first.pair)].is_loop;
    followers_.push_back(in_tree ? tree.offset[to_index(first.joint)] : -1);
    if (in_tree) follows_[to_index(followers_.back())] = true;
  }
}

ReferenceMotion<double> CouplingFollowers::given_motion(const Equations<double>& equations,
                                                        std::size_t k, double time) const {
  const Coupling& coupling = system_.topology().couplings[k];
  if (coupling.motion < 0) return {};
  return equations.formulas().view().design.motion[to_index(coupling.motion)].at(time);
}

// A follower may itself lead another coupling: after as many passes as there are couplings every
// chain of followers is consistent.
void CouplingFollowers::follow(const Equations<double>& equations, Posture* posture) const {
  const Constants<double>& constants = equations.constants();
  const std::vector<Coupling>& couplings = system_.topology().couplings;
  for (std::size_t pass = 0; pass < couplings.size(); ++pass) {
    for (std::size_t k = 0; k < couplings.size(); ++k) {
      if (followers_[k] < 0) continue;
      const ReferenceMotion<double> given = given_motion(equations, k, posture->time);
      double position = constants.couplings[k].offset + given.value, rate = given.rate;
      for (std::size_t t = 1; t < couplings[k].terms.size(); ++t) {
        const int c = tree_.offset[to_index(couplings[k].terms[t].joint)];
        position -= constants.couplings[k].coefficients[t] * posture->theta[c];
        rate -= constants.couplings[k].coefficients[t] * posture->rate[c];
      }
      const auto follower = to_index(followers_[k]);
      if (!posture->given.position[follower] && !posture->given.guess[follower])
        posture->theta[followers_[k]] = position;
      if (!posture->given.velocity[follower]) posture->rate[followers_[k]] = rate;
    }
  }
}

void CouplingFollowers::mark_driven(std::vector<bool>* flags) const {
  for (std::size_t k = 0; k < followers_.size(); ++k)
    if (system_.topology().couplings[k].motion >= 0 && followers_[k] >= 0)
      (*flags)[to_index(followers_[k])] = true;
}

void CouplingFollowers::by_preference(const std::vector<bool>& given,
                                      ColumnPreferences* lists) const {
  if (lists->size() < 2) lists->resize(2);
  for (std::vector<int>& list : *lists) list.clear();
  for (int c = 0; c < tree_.size; ++c)
    if (const auto k = to_index(c); !given[k]) (*lists)[follows_[k] ? 0 : 1].push_back(c);
}

}  // namespace codesign
