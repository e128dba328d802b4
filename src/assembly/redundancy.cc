// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/redundancy.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <random>

#include "assembly/determined_motion.h"
#include "equations/compiled_system.h"
#include "equations/formulas.h"
#include "math/arrays.h"
#include "math/euler_parameters.h"

namespace codesign {
namespace {

// Rank tolerance of the loops' scaled Jacobian: rounded angles and lengths leave less of a
// redundant row.
constexpr double kRankOfRows = 1e-3;
// Smaller components of a self-stress, relative to the largest, count as zero; far above rounding.
constexpr double kLoaded = 1e-7;
constexpr double kTestMotion = 0.2;  // [rad], or this fraction of a loop's longest lever
// Allowed error of a redundant row after the test motion; a row that is redundant at a singular
// start only misses ten times as much.
constexpr double kTestMiss = 2e-3;
constexpr int kTrials = 3;  // number of test motions, and of random self-stresses
// Redundant rows up to which a basis of the self-stresses is kept.
constexpr Eigen::Index kLargestBasis = 30;

std::string vector_name(const PairVector<double>& x) {
  if (x.terms == 2) return "d";
  const int index = x.term[0].shared % 4;
  return std::string(1, "xyz"[index]) + (x.term[0].side == Side::kI ? "_i" : "_j");
}

/// The kind of a scalar-product row, (6), and its vectors; d is the displacement from the joint's
/// point on body i to the one on body j.
std::string product_kind(const ProductRow<double>& row) {
  const std::string product = vector_name(row.X) + " . " + vector_name(row.Y);
  if (row.X.terms == 2 && row.Y.terms == 2) return "distance, " + product;
  if (row.X.terms == 2 || row.Y.terms == 2) return "point in a plane, " + product;
  const int x = row.X.term[0].shared % 4, y = row.Y.term[0].shared % 4;
  if (x == 2 && y == 2) return "constant angle, " + product;
  return (x == 2 || y == 2 ? "parallel axes, " : "no turn, ") + product;
}

/// Pseudo-random numbers between -1 and 1, the same in every run.
Eigen::MatrixXd mixed_numbers(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 generator(1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&generator] {
    return static_cast<double>(generator() % 2001) / 1000.0 - 1.0;
  });
}

/// The given rows of A as columns, without the columns of A that are zero in all of these rows.
SparseMatrix rows_as_columns(const Eigen::SparseMatrix<double, Eigen::RowMajor>& A,
                             const std::vector<int>& rows) {
  std::vector<Eigen::Triplet<double>> entries;
  std::map<Eigen::Index, int> place;
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(A, rows[k]); entry;
         ++entry)
      entries.emplace_back(place.emplace(entry.col(), static_cast<int>(place.size())).first->second,
                           static_cast<int>(k), entry.value());
  SparseMatrix result(to_signed(place.size()), to_signed(rows.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Tells rows that are redundant everywhere from rows that are redundant at the start only, by
/// moving the mechanism away from it.
class TestMotion {
 public:
  TestMotion(const CompiledSystem& system, Equations<double>* equations, const LoopJacobian& loops,
             const TreeLayout& tree, const std::vector<double>& parameters)
      : system_(system),
        equations_(equations),
        loops_(loops),
        tree_(tree),
        parameters_(parameters) {
    state_.resize(system.layout());
  }

  /// Removes the rows from `rows` (rows of the LoopJacobian) that are violated after a test motion
  /// along which the other rows hold.
  void sift(const VectorX<double>& theta, std::vector<int>* rows) {
    for (int trial = 0; trial < kTrials && !rows->empty(); ++trial) {
      held_.setOnes(loops_.rows());
      for (int row : *rows) held_[row] = 0.0;
      // A motion that is given would hold the mechanism where it is.
      for (std::size_t k = 0; k < system_.topology().couplings.size(); ++k)
        if (system_.topology().couplings[k].motion >= 0)
          held_[loops_.first_coupling_row() + static_cast<int>(k)] = 0.0;
      for (double size = kTestMotion; size > 0.1 * kTestMotion; size *= 0.5)
        if (try_motion(theta, trial, size, rows)) break;
    }
  }

 private:
  struct Linear {
    SparseMatrix matrix;
    LoopScales scales;
    LeastSquares inverse;
  };

  void linearize(const VectorX<double>& theta, Linear* l) const {
    l->matrix = loops_.evaluate(parameters_, theta, *equations_);
    l->scales = loops_.scales(l->matrix, *equations_);
    l->matrix = columns_of(held_.cwiseProduct(l->scales.rows).asDiagonal() * l->matrix *
                               l->scales.columns.asDiagonal(),
                           loops_.coordinates());
    l->inverse.factor(l->matrix, kRankOfRows);
  }

  void add(const Eigen::VectorXd& step, const LoopScales& scales, VectorX<double>* theta) const {
    for (std::size_t k = 0; k < loops_.coordinates().size(); ++k) {
      const int c = loops_.coordinates()[k];
      (*theta)[c] += scales.columns[c] * step[to_signed(k)];
    }
  }

  Eigen::VectorXd errors(const VectorX<double>& theta, const LoopScales& scales) {
    set_turns(system_, tree_, theta, &state_);
    const VectorX<double> rest = VectorX<double>::Zero(theta.size());
    state_coordinates(system_, tree_, equations_->constants(),
                      link_motions(system_.robot(), tree_, parameters_, theta, rest), theta, rest,
                      &state_.q, &state_.v);
    equations_->constraint_errors(state_, &Phi_, &Phi_rate_);
    return scales.rows.cwiseProduct(loops_.part_of(Phi_));
  }

  /// False if the other rows could not be satisfied after a motion of this size.
  bool try_motion(const VectorX<double>& start, int trial, double size, std::vector<int>* rows) {
    Linear l;
    linearize(start, &l);
    const Eigen::VectorXd before = errors(start, l.scales).cwiseAbs();
    Eigen::VectorXd direction =
        mixed_numbers(to_signed(loops_.coordinates().size()), kTrials).col(trial);
    direction -= l.inverse.solve(l.matrix * direction);
    const double largest = direction.cwiseAbs().maxCoeff();
    if (largest < 1e-9) return true;
    VectorX<double> theta = start;
    add(direction * (size / largest), l.scales, &theta);
    Eigen::VectorXd now;
    for (int iteration = 0; iteration < 20; ++iteration) {
      linearize(theta, &l);
      now = errors(theta, l.scales);
      const Eigen::VectorXd held = held_.cwiseProduct(now);
      if (!held.allFinite()) return false;
      if (held.cwiseAbs().maxCoeff() < 1e-9) break;
      add(-l.inverse.solve(held), l.scales, &theta);
    }
    if (!(held_.cwiseProduct(now).cwiseAbs().maxCoeff() < 1e-6)) return false;
    const double allowed = kTestMiss * size * size / (kTestMotion * kTestMotion);
    const auto fails = [&](int row) {
      return std::abs(now[row]) > std::max(allowed, 10.0 * before[row]);
    };
    rows->erase(std::remove_if(rows->begin(), rows->end(), fails), rows->end());
    return true;
  }

  const CompiledSystem& system_;
  Equations<double>* equations_;
  const LoopJacobian& loops_;
  const TreeLayout& tree_;
  const std::vector<double>& parameters_;
  Eigen::VectorXd held_;
  State<double> state_;
  VectorX<double> Phi_, Phi_rate_;
};

class Analysis {
 public:
  Analysis(const CompiledSystem& system, const Equations<double>& equations)
      : system_(system), layout_(system.layout()), equations_(equations) {}

  /// @param row of a loop or a coupling
  SharedRow place_of(int row) const {
    if (row >= layout_.coupling_row(0)) return {-1, row - layout_.coupling_row(0), 0};
    const int pair = pair_of(row);
    return {pair, -1, row - layout_.pair_row[to_index(pair)]};
  }

  ConstraintRow describe(int row) const {
    if (const int first = layout_.constraints() - layout_.norms(); row >= first) {
      int body = 0;
      while (!layout_.is_free(body) || layout_.norm_row(body) != row) ++body;
      return {system_.topology().bodies[to_index(body)].name, 1, "unit Euler parameters"};
    }
    if (row >= layout_.coupling_row(0)) {
      const Coupling& coupling =
          system_.topology().couplings[to_index(row - layout_.coupling_row(0))];
      return {coupling.name, 1, coupling.is_mimic ? "mimic" : "coupling"};
    }
    const std::size_t pair = to_index(pair_of(row));
    const int within = row - layout_.pair_row[pair];
    return {system_.topology().pairs[pair].name, within + 1, pair_row_kind(pair, within)};
  }

  /// Notes the joints, loops and couplings that the self-stresses (layout.constraints() x any
  /// number) load.
  void note_loaded(const Eigen::MatrixXd& stress, double threshold, Redundancy* result) const {
    const auto moves = [&](int first, int last) {
      return last > first &&
             stress.middleRows(first, last - first).cwiseAbs().maxCoeff() > threshold;
    };
    const Topology& topology = system_.topology();
    for (std::size_t k = 0; k < topology.pairs.size(); ++k) {
      if (!moves(layout_.pair_row[k], layout_.pair_end(static_cast<int>(k)))) continue;
      result->undetermined.push_back(topology.pairs[k].name);
      const int joint = topology.pairs[k].friction_joint;
      // All rows of a joint enter its normal force (12); of a plane only the first row does, and a
      // ball has no others.
      const bool plane = topology.pairs[k].kind->is_plane();
      if (joint < 0 || topology.pairs[k].friction_is_direct ||
          (plane && !moves(layout_.pair_row[k], layout_.pair_row[k] + 1)))
        continue;
      result->friction_chosen.push_back(topology.pairs[k].name);
      result->chosen_joints.push_back(joint);
    }
    for (std::size_t k = 0; k < topology.couplings.size(); ++k) {
      const int row = layout_.coupling_row(static_cast<int>(k));
      if (moves(row, row + 1)) result->undetermined.push_back(topology.couplings[k].name);
    }
  }

 private:
  int pair_of(int row) const {
    return static_cast<int>(
               std::upper_bound(layout_.pair_row.begin(), layout_.pair_row.end(), row) -
               layout_.pair_row.begin()) -
           1;
  }

  std::string pair_row_kind(std::size_t pair, int within) const {
    const PairRows<double>& rows = equations_.rows(static_cast<int>(pair));
    if (rows.coincident && within < 3)
      return std::string("coincident points, ground ") + "xyz"[within];
    return product_kind(rows.products[to_index(within - (rows.coincident ? 3 : 0))]);
  }

  const CompiledSystem& system_;
  const Layout& layout_;
  const Equations<double>& equations_;
};

/// The constraint rows' forces and torques on the free bodies, 6 x bodies by one column per row:
/// Phi_q^T in translations and rotations, in which the rows of the unit Euler parameters vanish.
SparseMatrix loads_of_rows(const CompiledSystem& system, const SparseMatrix& Phi_q,
                           const VectorX<double>& q, const std::vector<int>& rows) {
  const Layout& layout = system.layout();
  std::vector<int> body_of(to_index(layout.n), -1);
  for (int body = 0; body < layout.bodies; ++body)
    if (layout.is_free(body)) std::fill_n(body_of.begin() + layout.column(body), kBodySize, body);
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = Phi_q;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(by_rows, rows[k]); entry;
         ++entry) {
      const int column = static_cast<int>(entry.col()), body = body_of[to_index(column)];
      if (body < 0) continue;
      const int first = layout.column(body), local = column - first;
      if (local < 3) {
        entries.emplace_back(6 * body + local, static_cast<int>(k), entry.value());
        continue;
      }
      const Eigen::Vector3d turn =
          0.5 * ground_rate_matrix<double>(q.segment<4>(first + 3)).col(local - 3);
      for (int c = 0; c < 3; ++c)
        entries.emplace_back(6 * body + 3 + c, static_cast<int>(k), entry.value() * turn[c]);
    }
  SparseMatrix result(6 * system.layout().bodies, to_signed(rows.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// An orthonormal basis of the columns of A, which are independent: Gram and Schmidt's, repeated
/// against rounding.
Eigen::MatrixXd orthonormal(Eigen::MatrixXd A) {
  for (int pass = 0; pass < 2; ++pass)
    for (Eigen::Index k = 0; k < A.cols(); ++k) {
      for (Eigen::Index other = 0; other < k; ++other)
        A.col(k) -= A.col(other).dot(A.col(k)) * A.col(other);
      A.col(k).normalize();
    }
  return A;
}

/// Finds self-stresses: random loads of the redundant rows, with the loads of the other rows that
/// balance them.
void find_undetermined(const CompiledSystem& system, Equations<double>* equations,
                       const State<double>& state, const Analysis& analysis,
                       const std::vector<int>& redundant, const ReactionSharing& sharing,
                       Redundancy* result) {
  const Layout& layout = system.layout();
  std::vector<int> others;
  const auto add = [&](int first, int last) {
    for (int row = first; row < last; ++row)
      if (!std::binary_search(redundant.begin(), redundant.end(), row)) others.push_back(row);
  };
  for (int pair : sharing.pairs) add(layout.pair_row[to_index(pair)], layout.pair_end(pair));
  for (int coupling : sharing.couplings)
    add(layout.coupling_row(coupling), layout.coupling_row(coupling) + 1);
  const SparseMatrix Phi_q = constraint_jacobian(system, equations, state);
  const SparseMatrix kept = loads_of_rows(system, Phi_q, state.q, others),
                     open = loads_of_rows(system, Phi_q, state.q, redundant);
  // Random loads of the redundant rows, then, for a basis, a unit load of each.
  const Eigen::Index units = open.cols() <= kLargestBasis ? open.cols() : 0;
  Eigen::MatrixXd chosen(open.cols(), kTrials + units);
  chosen << mixed_numbers(open.cols(), kTrials), Eigen::MatrixXd::Identity(open.cols(), units);
  LeastSquares balance;
  balance.factor(kept, 1e-9);
  const Eigen::MatrixXd answer = balance.solve(Eigen::MatrixXd(-(open * chosen)));
  const double left = (kept * answer + open * chosen).leftCols(kTrials).cwiseAbs().maxCoeff();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(layout.constraints(), chosen.cols());
  for (std::size_t k = 0; k < redundant.size(); ++k)
    all.row(redundant[k]) = chosen.row(to_signed(k));
  for (std::size_t k = 0; k < others.size(); ++k) all.row(others[k]) = answer.row(to_signed(k));
  Eigen::MatrixXd stress = all.leftCols(kTrials);
  if (units > 0) result->basis = orthonormal(all.rightCols(units));
  result->stress_threshold = kLoaded * stress.cwiseAbs().maxCoeff() + 100.0 * left;
  analysis.note_loaded(stress, result->stress_threshold, result);
  result->self_stress = std::move(stress);
}

}  // namespace

Redundancy analyse_redundancy(const CompiledSystem& system, Equations<double>* equations,
                              const Assembly& assembly, const std::vector<double>& parameters,
                              const State<double>& state) {
  Redundancy result;
  const LoopJacobian& loops = assembly.loops();
  if (loops.rows() == 0) return result;
  const SparseMatrix jacobian = loops.evaluate(parameters, assembly.theta(), *equations);
  const LoopScales scales = loops.scales(jacobian, *equations);
  const Eigen::SparseMatrix<double, Eigen::RowMajor> scaled =
      scales.rows.asDiagonal() * jacobian * scales.columns.asDiagonal();
  std::vector<int> rows, redundant;
  for (const LoopJacobian::Part& part : loops.parts()) {
    const std::vector<int> dependent =
        dependent_columns(rows_as_columns(scaled, part.rows), kRankOfRows);
    if (dependent.empty()) continue;
    for (int k : dependent) rows.push_back(part.rows[to_index(k)]);
    result.sharing.pairs.insert(result.sharing.pairs.end(), part.pairs.begin(), part.pairs.end());
    const auto is_given = [&](int k) {
      return system.topology().couplings[to_index(k)].motion >= 0;
    };
    std::remove_copy_if(part.couplings.begin(), part.couplings.end(),
                        std::back_inserter(result.sharing.couplings), is_given);
  }
  if (rows.empty()) return result;
  for (std::vector<int>* list : {&result.sharing.pairs, &result.sharing.couplings})
    std::sort(list->begin(), list->end());
  for (int row : rows) redundant.push_back(loops.constraint_rows()[to_index(row)]);
  std::sort(redundant.begin(), redundant.end());
  const Analysis analysis(system, *equations);
  for (int row : redundant) result.rows.push_back(analysis.describe(row));
  // Self-stresses are those of the rows of all joints of the loops.
  const std::vector<int>& shared = result.sharing.pairs;
  if (std::any_of(shared.begin(), shared.end(),
                  [&](int pair) { return !system.layout().is_cut(pair); }))
    return result;
  find_undetermined(system, equations, state, analysis, redundant, result.sharing, &result);
  TestMotion(system, equations, loops, assembly.tree(), parameters).sift(assembly.theta(), &rows);
  for (int row : rows)
    result.sharing.dropped.push_back(analysis.place_of(loops.constraint_rows()[to_index(row)]));
  return result;
}

std::vector<std::size_t> open_reactions(const CompiledSystem& system, const Redundancy& redundancy,
                                        State<double> state, const std::vector<Signal>& signals,
                                        Equations<double>* equations) {
  const Layout& layout = system.layout();
  std::vector<bool> open(signals.size(), false);
  state.z.setZero(layout.columns());
  for (Eigen::Index trial = 0; trial < redundancy.self_stress.cols(); ++trial) {
    state.z.segment(layout.n, layout.constraints()) = redundancy.self_stress.col(trial);
    equations->formulas().load(state);
    for (std::size_t k = 0; k < signals.size(); ++k) {
      double moved = 0.0;
      for (const SignalReference& term : signals[k])
        if (term.kind == SignalKind::kReactionForce || term.kind == SignalKind::kReactionTorque)
          moved += term.factor * equations->formulas().multiplier_reaction(term);
      if (std::abs(moved) > redundancy.stress_threshold) open[k] = true;
    }
  }
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < open.size(); ++k)
    if (open[k]) found.push_back(k);
  return found;
}

}  // namespace codesign
