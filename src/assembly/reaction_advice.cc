// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/reaction_advice.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "assembly/assembly.h"
#include "equations/compiled_system.h"
#include "equations/formulas.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "mechanism/loop_plane.h"
#include "mechanism/signal_catalog.h"

namespace codesign {
namespace {

constexpr double kRankOfStress = 1e-7;  // relative; smaller pivots of self-stresses count as zero
constexpr std::size_t kMostCompared = 40;  // candidates of which pairs and triples are compared

/// The reactions of each self-stress that a release would remove: one row per freedom, one column
/// per self-stress.
struct Candidate {
  Release release;
  Eigen::MatrixXd removed;
};

class Search {
 public:
  Search(const CompiledSystem& system, const Redundancy& redundancy, const State<double>& state,
         Equations<double>* equations)
      : system_(system), basis_(redundancy.basis) {
    for (const bool loops : {true, false})
      for (int pair : redundancy.sharing.pairs) add_candidates(pair, loops, state, equations);
    find_friction_rows(redundancy);
  }

  /// What shall be determined in place of friction: rows that are zero for a self-stress which does
  /// not change it, one column per self-stress of the basis.
  void determine(Eigen::MatrixXd rows) { friction_ = std::move(rows); }

  std::vector<Release> smallest() const {
    if (basis_.cols() == 0) return {};
    for (std::size_t size = 1; size <= 3 && candidates_.size() <= kMostCompared; ++size) {
      std::vector<std::size_t> set;
      if (extend(size, 0, &set)) return releases(set);
    }
    return releases(one_by_one());
  }

 private:
  void add_candidates(int pair, bool loops, const State<double>& state,
                      Equations<double>* equations) {
    const Pair& p = system_.topology().pairs[to_index(pair)];
    if (p.is_loop != loops || p.chain.size() != 1 ||
        (p.kind != PairKind::kRevolute && p.kind != PairKind::kPrismatic))
      return;
    Eigen::MatrixXd forces(3, basis_.cols()), torques(3, basis_.cols());
    State<double> stressed = state;
    stressed.z.setZero(system_.layout().columns());
    for (Eigen::Index k = 0; k < basis_.cols(); ++k) {
      stressed.z.segment(system_.layout().n, system_.layout().constraints()) = basis_.col(k);
      equations->formulas().load(stressed);
      Vector3<double> F, T;
      equations->formulas().reaction(pair, &F, &T);
      forces.col(k) = F;
      torques.col(k) = T;
    }
    const int joint = p.chain.front().joint;
    if (p.kind == PairKind::kRevolute)
      candidates_.push_back({{joint, JointType::kSpherical}, torques.topRows(2)});
    candidates_.push_back(
        {{joint, JointType::kCylindrical},
         p.kind == PairKind::kRevolute ? forces.bottomRows(1) : torques.bottomRows(1)});
  }

  void find_friction_rows(const Redundancy& redundancy) {
    const std::vector<Pair>& pairs = system_.topology().pairs;
    std::vector<int> rows;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const std::vector<int>& chosen = redundancy.chosen_joints;
      if (std::find(chosen.begin(), chosen.end(), pairs[p].friction_joint) == chosen.end())
        continue;
      const int first = system_.layout().pair_row[p],
                end = system_.layout().pair_end(static_cast<int>(p));
      const bool plane = pairs[p].kind->is_plane();
      for (int row = first; row < (plane ? first + 1 : end); ++row) rows.push_back(row);
    }
    friction_.resize(to_signed(rows.size()), basis_.cols());
    for (std::size_t k = 0; k < rows.size(); ++k) friction_.row(to_signed(k)) = basis_.row(rows[k]);
  }

  Eigen::MatrixXd removed_by(const std::vector<std::size_t>& set) const {
    Eigen::MatrixXd all(0, basis_.cols());
    for (std::size_t k : set) {
      const Eigen::MatrixXd& more = candidates_[k].removed;
      all.conservativeResize(all.rows() + more.rows(), Eigen::NoChange);
      all.bottomRows(more.rows()) = more;
    }
    return all;
  }

  /// Whether each freedom removes a self-stress, instead of adding a motion.
  bool is_admissible(const std::vector<std::size_t>& set) const {
    const Eigen::MatrixXd removed = removed_by(set);
    if (removed.rows() > removed.cols()) return false;
    const Eigen::VectorXd values = singular_values(removed).values;
    return values.size() > 0 &&
           values[values.size() - 1] > kRankOfStress * std::max(1.0, values[0]);
  }

  /// Whether no self-stress that remains loads a joint with friction.
  bool determines(const std::vector<std::size_t>& set) const {
    if (set.empty()) return false;
    const Eigen::MatrixXd left =
        friction_ * orthogonal_complement(removed_by(set).transpose(), kRankOfStress);
    return left.size() == 0 || left.cwiseAbs().maxCoeff() <= kRankOfStress;
  }

  bool has_joint_of(const std::vector<std::size_t>& set, std::size_t candidate) const {
    return std::any_of(set.begin(), set.end(), [&](std::size_t k) {
      return candidates_[k].release.joint == candidates_[candidate].release.joint;
    });
  }

  /// Extends `set` by `more` candidates from `first` on; true once it determines the friction.
  bool extend(std::size_t more, std::size_t first, std::vector<std::size_t>* set) const {
    if (more == 0) return is_admissible(*set) && determines(*set);
    for (std::size_t k = first; k < candidates_.size(); ++k) {
      if (has_joint_of(*set, k)) continue;
      set->push_back(k);
      if (extend(more - 1, k + 1, set)) return true;
      set->pop_back();
    }
    return false;
  }

  std::vector<std::size_t> one_by_one() const {
    std::vector<std::size_t> set;
    for (std::size_t k = 0; k < candidates_.size() && !determines(set); ++k) {
      if (has_joint_of(set, k)) continue;
      set.push_back(k);
      if (!is_admissible(set)) set.pop_back();
    }
    if (!determines(set)) return {};
    for (std::size_t k = set.size(); k-- > 0;) {
      std::vector<std::size_t> without = set;
      without.erase(without.begin() + to_signed(k));
      if (determines(without)) set.swap(without);
    }
    return set;
  }

  std::vector<Release> releases(const std::vector<std::size_t>& set) const {
    std::vector<Release> result;
    for (std::size_t k : set) result.push_back(candidates_[k].release);
    return result;
  }

  const CompiledSystem& system_;
  const Eigen::MatrixXd& basis_;
  std::vector<Candidate> candidates_;
  Eigen::MatrixXd friction_;  ///< rows of the basis that friction depends on, or determine()
};

/// Random weights of the reactions, one for the force and one for the torque of each pair, so that
/// no direction is special.
Eigen::VectorXd stiffness_weights(const CompiledSystem& system, std::mt19937* generator) {
  const auto weight = [generator] {
    return std::pow(10.0, static_cast<double>((*generator)() % 2001) / 1000.0 - 1.0);
  };
  const Layout& layout = system.layout();
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(layout.constraints());
  for (std::size_t p = 0; p < system.topology().pairs.size(); ++p) {
    const int force = system.topology().pairs[p].kind->force_rows();
    const int first = layout.pair_row[p], end = layout.pair_end(static_cast<int>(p));
    const double of_force = weight(), of_torque = weight();
    for (int row = first; row < end; ++row)
      weights[row] = row < first + force ? of_force : of_torque;
  }
  return weights;
}

/// By how much each self-stress of the basis changes the reactions that the open signals read: one
/// row per term.
Eigen::MatrixXd reaction_rows(const CompiledSystem& system, const Redundancy& redundancy,
                              State<double> state, const std::vector<Signal>& signals,
                              const std::vector<std::size_t>& open, Equations<double>* equations) {
  std::vector<SignalReference> terms;
  for (std::size_t k : open)
    for (const SignalReference& term : signals[k])
      if (term.kind == SignalKind::kReactionForce || term.kind == SignalKind::kReactionTorque)
        terms.push_back(term);
  Eigen::MatrixXd rows(to_signed(terms.size()), redundancy.basis.cols());
  state.z.setZero(system.layout().columns());
  for (Eigen::Index column = 0; column < rows.cols(); ++column) {
    state.z.segment(system.layout().n, system.layout().constraints()) =
        redundancy.basis.col(column);
    equations->formulas().load(state);
    for (std::size_t k = 0; k < terms.size(); ++k)
      rows(to_signed(k), column) = equations->formulas().multiplier_reaction(terms[k]);
  }
  return rows;
}

}  // namespace

std::string name_list(const RobotDescription& robot, const std::vector<int>& joints) {
  std::string text;
  for (int joint : joints)
    text += (text.empty() ? "'" : ", '") + robot.joints[to_index(joint)].name + "'";
  return text;
}

std::string plane_advice(const CompiledSystem& system, const ReactionSharing& sharing) {
  std::vector<int> loops;
  for (int p : sharing.pairs) {
    const Pair& pair = system.topology().pairs[to_index(p)];
    if (!pair.is_loop) continue;
    if (!could_be_in_plane(system.robot(), system.topology(), pair, system.parameters())) return "";
    loops.push_back(pair.chain[0].joint);
  }
  if (loops.empty()) return "";
  return "; or, as the motion is planar, leave what acts out of the plane to the joints of "
         "the tree by codesign:out_of_plane=\"zero\" on " +
         name_list(system.robot(), loops);
}

std::string advice_of(const RobotDescription& robot, const std::vector<Release>& releases) {
  if (releases.empty())
    return "no freedoms as codesign:spherical or codesign:cylindrical in place of hinges and "
           "slides determine all of it; give the loops "
           "joints of other types";
  std::string text;
  bool in_tree = false;
  for (const Release& release : releases) {
    const JointDescription& joint = robot.joints[to_index(release.joint)];
    in_tree = in_tree || !joint.is_loop;
    text += (text.empty() ? "'" : " and '") + joint.name + "' as codesign:" +
            (release.type == JointType::kSpherical ? "spherical" : "cylindrical");
  }
  return "to remove the warning, give the freedom that bearings have in reality to " + text +
         ": this determines all of it, and none of them can be left out" +
         (in_tree ? " (a joint of the tree by type=\"floating\" codesign:type=..., "
                    "doc/annotations.md, Further joints)"
                  : "");
}

std::vector<Release> releases_for_friction(const CompiledSystem& system,
                                           const Redundancy& redundancy, const State<double>& state,
                                           Equations<double>* equations) {
  return Search(system, redundancy, state, equations).smallest();
}

double effect_of_sharing(const CompiledSystem& system, const Redundancy& redundancy,
                         State<double> state, Equations<double>* equations) {
  constexpr int kDistributions = 4;
  const Layout& layout = system.layout();
  if (redundancy.basis.cols() == 0) return -1.0;
  const auto normal_forces = [&] {
    equations->formulas().load(state);
    std::vector<double> forces;
    for (int p : redundancy.sharing.pairs) {
      const int joint = system.topology().pairs[to_index(p)].friction_joint;
      const std::vector<int>& chosen = redundancy.chosen_joints;
      if (std::find(chosen.begin(), chosen.end(), joint) != chosen.end())
        forces.push_back(equations->formulas().normal_force(p));
    }
    return forces;
  };
  const std::vector<double> usual = normal_forces();
  const Eigen::VectorXd lambda = state.z.segment(layout.n, layout.constraints());
  double mass = 0.0;
  for (const BodyConstants<double>& body : equations->constants().bodies) mass += body.mass;
  const double load = lambda.cwiseAbs().maxCoeff(),
               largest = *std::max_element(usual.begin(), usual.end());
  // [m/s^2] times the mass: at rest without gravity reactions are rounding.
  constexpr double kNoLoad = 1e-9;
  if (!(load > kNoLoad * mass && largest > kNoLoad * load)) return -1.0;
  std::mt19937 generator(1);
  double change = 0.0;
  for (int trial = 0; trial < kDistributions; ++trial) {
    const Eigen::VectorXd weights = stiffness_weights(system, &generator);
    const Eigen::MatrixXd weighted = weights.asDiagonal() * redundancy.basis;
    const Eigen::VectorXd other =
        lambda - redundancy.basis *
                     least_norm(weighted).solve(Eigen::VectorXd(weights.cwiseProduct(lambda)));
    state.z.segment(layout.n, layout.constraints()) = other;
    const std::vector<double> forces = normal_forces();
    for (std::size_t k = 0; k < forces.size(); ++k)
      change = std::max(change, std::abs(forces[k] - usual[k]));
  }
  return change / largest;
}

Warnings warn_of_open_reactions(const CompiledSystem& system, const Redundancy& redundancy,
                                const State<double>& state,
                                const std::vector<SignalDescription>& signals,
                                Equations<double>* equations) {
  std::vector<Signal> resolved;
  resolved.reserve(signals.size());
  for (const SignalDescription& signal : signals)
    resolved.push_back(resolve_signal(signal, system.robot(), system.topology(),
                                      system.study().controllers, system.study().parameters));
  Warnings warnings;
  const std::vector<std::size_t> open =
      open_reactions(system, redundancy, state, resolved, equations);
  if (open.empty()) return warnings;
  Search search(system, redundancy, state, equations);
  search.determine(reaction_rows(system, redundancy, state, resolved, open, equations));
  const std::string advice =
      advice_of(system.robot(), search.smallest()) + plane_advice(system, redundancy.sharing);
  for (std::size_t k : open)
    append({warn("undetermined_reaction",
                 {signals[k].where, "signal",
                  "the signal reads a reaction that is not unique, because the loop has redundant "
                  "constraints; the one of least norm is used; " +
                      advice,
                  signals[k].text, ""})},
           &warnings);
  return warnings;
}

Warnings warn_of_open_reactions(const CompiledSystem& system,
                                const std::vector<SignalDescription>& signals) {
  const auto reads_one = [](const SignalDescription& signal) {
    return std::any_of(signal.terms.begin(), signal.terms.end(),
                       [](const SignalTerm& term) { return is_reaction(term); });
  };
  if (std::none_of(signals.begin(), signals.end(), reads_one)) return {};
  StartWorkspace start(system, system.parameters());
  if (!start.solve_positions().ok()) return {};
  const Redundancy redundancy =
      analyse_redundancy(system, &start.equations, start.assembly, start.parameters, start.state);
  return warn_of_open_reactions(system, redundancy, start.state, signals, &start.equations);
}

}  // namespace codesign
