// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/loop_jacobian.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "equations/formulas.h"
#include "math/arrays.h"

namespace codesign {
namespace {

constexpr int kMostRows = 6;  // constraint rows of one pair

/// Union-find over the numbers 0 .. size - 1.
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int k) {
    while (parent_[to_index(k)] != k)
      k = parent_[to_index(k)] = parent_[to_index(parent_[to_index(k)])];
    return k;
  }
  void join(int a, int b) { parent_[to_index(find(a))] = find(b); }

 private:
  std::vector<int> parent_;
};

/// Sets the velocities of a body for the unit rate of one coordinate.
void move(const CoordinateTwist& twist, BodyKinematics<double>* body) {
  body->rd = twist.velocity + cross<double>(twist.omega, body->r - twist.point);
  body->pd = 0.5 * (ground_rate_matrix(body->p).transpose() * twist.omega);
  body->Ad = rotation_derivative(body->p, body->pd);
}

BodyKinematics<double> standing(const VectorX<double>& q, int body) {
  BodyKinematics<double> k;
  k.at_rest = body < 0;
  if (k.at_rest) return k;
  const Eigen::Index first = Eigen::Index{kBodySize} * body;
  k.r = q.segment<3>(first);
  k.p = q.segment<4>(first + 3);
  k.update_rotation();
  return k;
}

}  // namespace

LoopJacobian::LoopJacobian(const CompiledSystem& system, const TreeLayout& tree)
    : system_(system),
      tree_(tree),
      joint_of_(to_index(tree.size), -1),
      slides_(to_index(tree.size), false) {
  for (int joint : tree.joint_order) {
    const JointFreedoms& freedoms = system.robot().joints[to_index(joint)].freedoms();
    const int first = tree.offset[to_index(joint)];
    for (int k = 0; k < freedoms.size(); ++k) {
      joint_of_[to_index(first + k)] = joint;
      slides_[to_index(first + k)] = k < freedoms.slides;
    }
  }
  const Topology& topology = system.topology();
  for (std::size_t k = 0; k < topology.pairs.size(); ++k)
    if (topology.pairs[k].is_loop) add_loop(static_cast<int>(k));
  first_coupling_row_ = rows();
  for (std::size_t k = 0; k < topology.couplings.size(); ++k) {
    add_row(system.layout().coupling_row(static_cast<int>(k)), topology.couplings[k].name);
    couplings_.emplace_back();
    for (const CouplingTerm& term : topology.couplings[k].terms) {
      couplings_.back().push_back(movers_of(term));
      for (const Mover& mover : couplings_.back().back().movers)
        coordinates_.push_back(mover.coordinate);
    }
  }
  std::sort(coordinates_.begin(), coordinates_.end());
  coordinates_.erase(std::unique(coordinates_.begin(), coordinates_.end()), coordinates_.end());
  find_pattern();
}

/// The coordinates that move the coordinate of a term: it is one of the tree, or that of a loop.
LoopJacobian::Loop LoopJacobian::movers_of(const CouplingTerm& term) const {
  for (const Loop& loop : loops_)
    if (loop.pair == term.pair) return loop;
  return {-1, -1, {{tree_.offset[to_index(term.joint)], true}}};
}

void LoopJacobian::find_pattern() {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Loop& loop : loops_)
    for (const Mover& mover : loop.movers)
      for (int k = 0; k < rows_of(loop); ++k)
        entries.emplace_back(loop.first_row + k, mover.coordinate, 0.0);
  for (std::size_t k = 0; k < couplings_.size(); ++k)
    for (const Loop& term : couplings_[k])
      for (const Mover& mover : term.movers)
        entries.emplace_back(first_coupling_row_ + static_cast<int>(k), mover.coordinate, 0.0);
  pattern_.resize(rows(), tree_.size);
  pattern_.setFromTriplets(entries.begin(), entries.end());
  std::vector<bool> seen(to_index(static_cast<int>(pattern_.nonZeros())), false);
  for (const Eigen::Triplet<double>& entry : entries) {
    const int* const begin = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[entry.col()];
    const int* const end = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[entry.col() + 1];
    const auto slot =
        static_cast<int>(std::lower_bound(begin, end, entry.row()) - pattern_.innerIndexPtr());
    places_.push_back({slot, !seen[to_index(slot)]});
    seen[to_index(slot)] = true;
  }
}

void LoopJacobian::add_row(int row, const std::string& owner) {
  constraint_rows_.push_back(row);
  owners_.push_back(owner);
}

// Collects the joints from both bodies towards the root; joints on both ways move the loop as a
// whole and are left out.
void LoopJacobian::add_loop(int index) {
  const Topology& topology = system_.topology();
  const Pair& pair = topology.pairs[to_index(index)];
  const auto joints_above = [&](int body) {
    std::vector<int> joints;
    if (body < 0) return joints;
    for (int joint =
             topology.link_parent_joint[to_index(topology.bodies[to_index(body)].base_link)];
         joint >= 0;
         joint =
             topology.link_parent_joint[to_index(system_.robot().joints[to_index(joint)].parent)])
      joints.push_back(joint);
    return joints;
  };
  std::vector<int> above_i = joints_above(pair.body_i), above_j = joints_above(pair.body_j);
  while (!above_i.empty() && !above_j.empty() && above_i.back() == above_j.back()) {
    above_i.pop_back();
    above_j.pop_back();
  }
  Loop loop{index, rows(), {}};
  const auto add = [&](const std::vector<int>& joints, bool moves_j) {
    for (int joint : joints)
      for (int k = 0; k < system_.robot().joints[to_index(joint)].freedoms().size(); ++k) {
        loop.movers.push_back({tree_.offset[to_index(joint)] + k, moves_j});
        coordinates_.push_back(loop.movers.back().coordinate);
      }
  };
  add(above_i, false);
  add(above_j, true);
  for (int row = system_.layout().pair_row[to_index(index)]; row < system_.layout().pair_end(index);
       ++row)
    add_row(row, pair.name);
  loops_.push_back(loop);
}

std::string LoopJacobian::first_owner(int coordinate) const {
  const SparseMatrix::InnerIterator entry(pattern_, coordinate);
  return entry ? owner(static_cast<int>(entry.row())) : std::string();
}

SparseMatrix LoopJacobian::evaluate(const std::vector<double>& parameters,
                                    const VectorX<double>& theta,
                                    const Equations<double>& equations) const {
  LoopWorkspace workspace;
  SparseMatrix jacobian;
  evaluate(parameters, theta, equations, &workspace, &jacobian);
  return jacobian;
}

void LoopJacobian::evaluate(const std::vector<double>& parameters, const VectorX<double>& theta,
                            const Equations<double>& equations, LoopWorkspace* workspace,
                            SparseMatrix* jacobian) const {
  *jacobian = pattern_;
  if (rows() == 0) return;
  LoopWorkspace& w = *workspace;
  w.standstill.setZero(tree_.size);
  link_motions(system_.robot(), tree_, parameters, theta, w.standstill, &w.links);
  coordinate_twists(system_.robot(), tree_, parameters, theta, w.links, &w.twists);
  body_coordinates(system_, equations.constants(), w.links, &w.q, &w.v);
  auto place = places_.begin();
  const auto add = [&](double x) {
    double& entry = jacobian->valuePtr()[place->slot];
    entry = place->is_first ? x : entry + x;
    ++place;
  };
  double errors[kMostRows], rates[kMostRows];
  // Calls visit(body i, body j) for the unit rate of each coordinate that moves a loop.
  const auto move_each = [&](const Loop& loop, const auto& visit) {
    const Pair& pair = system_.topology().pairs[to_index(loop.pair)];
    const BodyKinematics<double> i = standing(w.q, pair.body_i), j = standing(w.q, pair.body_j);
    for (const Mover& mover : loop.movers) {
      BodyKinematics<double> moved = mover.moves_j ? j : i;
      move(w.twists[to_index(mover.coordinate)], &moved);
      visit(mover.moves_j ? i : moved, mover.moves_j ? moved : j);
    }
  };
  for (const Loop& loop : loops_) {
    const int size = rows_of(loop);
    move_each(loop, [&](const auto& i, const auto& j) {
      equations.formulas().pair_errors(loop.pair, i, j, Out<double>(errors).first(size),
                                       Out<double>(rates).first(size));
      for (int k = 0; k < size; ++k) add(rates[k]);
    });
  }
  for (std::size_t k = 0; k < couplings_.size(); ++k) {
    const std::vector<double>& coefficients = equations.constants().couplings[k].coefficients;
    for (std::size_t t = 0; t < couplings_[k].size(); ++t) {
      const Loop& term = couplings_[k][t];
      if (term.pair < 0) {
        add(coefficients[t]);
        continue;
      }
      const PairConstants<double>& pair = equations.constants().pairs[to_index(term.pair)];
      const int element = system_.topology().couplings[k].terms[t].element;
      move_each(term, [&](const auto& i, const auto& j) {
        add(coefficients[t] * coordinate_motion(pair, pair.coordinates[to_index(element)], i, j,
                                                CoordinateDetail::kRate)
                                  .rate);
      });
    }
  }
}

int LoopJacobian::power(const Loop& loop, int within, const Equations<double>& equations) {
  const PairRows<double>& kinds = equations.rows(loop.pair);
  if (kinds.coincident && within < 3) return 1;
  const ProductRow<double>& product = kinds.products[to_index(within - (kinds.coincident ? 3 : 0))];
  return (product.X.terms == 2 ? 1 : 0) + (product.Y.terms == 2 ? 1 : 0);
}

LoopScales LoopJacobian::scales(const SparseMatrix& jacobian,
                                const Equations<double>& equations) const {
  LoopWorkspace workspace;
  LoopScales result;
  scales(jacobian, equations, &workspace, &result);
  return result;
}

void LoopJacobian::scales(const SparseMatrix& jacobian, const Equations<double>& equations,
                          LoopWorkspace* workspace, LoopScales* result) const {
  LoopWorkspace& w = *workspace;
  w.largest.setZero(rows());
  w.largest_turn.setZero(rows());
  for (int c = 0; c < tree_.size; ++c)
    for (SparseMatrix::InnerIterator entry(jacobian, c); entry; ++entry) {
      w.largest[entry.row()] = std::max(w.largest[entry.row()], std::abs(entry.value()));
      if (!slides(c))
        w.largest_turn[entry.row()] =
            std::max(w.largest_turn[entry.row()], std::abs(entry.value()));
    }
  const auto or_one = [](double value) { return value > 0.0 ? value : 1.0; };
  LoopScales& scales = *result;
  scales.rows.setOnes(rows());
  scales.columns.setOnes(jacobian.cols());
  for (const Loop& loop : loops_) {
    double lever = 0.0;
    for (int k = 0; k < rows_of(loop); ++k)
      if (power(loop, k, equations) == 1)
        lever = std::max(lever, or_one(w.largest_turn[loop.first_row + k]));
    for (int k = 0; k < rows_of(loop); ++k) {
      const int order = power(loop, k, equations), row = loop.first_row + k;
      if (order > 0) scales.rows[row] = 1.0 / (order == 1 ? lever : or_one(w.largest[row]));
    }
  }
  for (int k = first_coupling_row_; k < rows(); ++k) scales.rows[k] = 1.0 / or_one(w.largest[k]);
  for (int c : coordinates_) {
    if (!slides(c)) continue;
    double value = 0.0;
    for (SparseMatrix::InnerIterator entry(jacobian, c); entry; ++entry)
      value = std::max(value, std::abs(entry.value()) * scales.rows[entry.row()]);
    if (value > 0.0) scales.columns[c] = 1.0 / value;
  }
}

LoopMiss LoopJacobian::miss(std::size_t owner, const VectorX<double>& errors,
                            const Equations<double>& equations) const {
  const auto error = [&](int row) { return std::abs(errors[constraint_rows_[to_index(row)]]); };
  if (owner >= loops_.size()) {
    const int row = first_coupling_row_ + static_cast<int>(owner - loops_.size());
    return {owners_[to_index(row)], 0.0, error(row)};
  }
  const Loop& loop = loops_[owner];
  LoopMiss miss{system_.topology().pairs[to_index(loop.pair)].name, 0.0, 0.0};
  for (int k = 0; k < rows_of(loop); ++k) {
    const double size = error(loop.first_row + k);
    const int order = power(loop, k, equations);
    const double length =
        order == 2 ? equations.constants().pairs[to_index(loop.pair)].distance : 1.0;
    double& part = order == 0 ? miss.angle : miss.length;
    part = std::max(part, length > 0.0 ? size / length : std::sqrt(2.0 * size));
  }
  return miss;
}

std::vector<LoopJacobian::Part> LoopJacobian::parts() const {
  const Topology& topology = system_.topology();
  Sets sets(to_index(tree_.size + rows()));  // coordinates, then rows
  for (const Loop& loop : loops_) {
    const int count = rows_of(loop);
    for (int k = 0; k < count; ++k)
      sets.join(tree_.size + loop.first_row + k, tree_.size + loop.first_row);
    for (const Mover& mover : loop.movers) sets.join(mover.coordinate, tree_.size + loop.first_row);
  }
  for (std::size_t k = 0; k < topology.couplings.size(); ++k)
    for (const Loop& term : couplings_[k])
      for (const Mover& mover : term.movers)
        sets.join(mover.coordinate, tree_.size + first_coupling_row_ + static_cast<int>(k));
  std::vector<Part> parts;
  std::vector<int> part_of(to_index(tree_.size + rows()), -1);
  for (int row = 0; row < rows(); ++row) {
    int& part = part_of[to_index(sets.find(tree_.size + row))];
    if (part < 0) {
      part = static_cast<int>(parts.size());
      parts.emplace_back();
    }
    parts[to_index(part)].rows.push_back(row);
    if (row >= first_coupling_row_)
      parts[to_index(part)].couplings.push_back(row - first_coupling_row_);
  }
  std::vector<int> pair_part(topology.pairs.size(), -1);
  for (const Loop& loop : loops_)
    if (rows_of(loop) > 0)
      pair_part[to_index(loop.pair)] = part_of[to_index(sets.find(tree_.size + loop.first_row))];
  for (int c : coordinates_) {
    const int pair = topology.joint_pair[to_index(joint_of_[to_index(c)])];
    if (pair >= 0) pair_part[to_index(pair)] = part_of[to_index(sets.find(c))];
  }
  for (std::size_t pair = 0; pair < pair_part.size(); ++pair)
    if (pair_part[pair] >= 0)
      parts[to_index(pair_part[pair])].pairs.push_back(static_cast<int>(pair));
  return parts;
}

int LoopJacobian::rows_of(const Loop& loop) const {
  return system_.layout().pair_end(loop.pair) - system_.layout().pair_row[to_index(loop.pair)];
}

}  // namespace codesign
