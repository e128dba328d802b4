// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/dynamics/redundancy.h"

#include <Eigen/QR>

namespace codesign {
namespace {

constexpr double kRankTolerance = 1e-9;
constexpr double kTakesPart = 1e-7;  // of a unit vector of the null space: far above its rounding

std::string vector_name(const PairVector<double>& x) {
  if (x.terms == 2) return "d";
  const int index = x.term[0].shared % 4;
  return std::string(1, "xyz"[index]) + (x.term[0].side == Side::kI ? "_i" : "_j");
}

/// The product and what it says: a displacement is d, from the joint's point on i to that on j.
std::string product_kind(const ProductRow<double>& row) {
  const std::string product = vector_name(row.X) + " . " + vector_name(row.Y);
  if (row.X.terms == 2 && row.Y.terms == 2) return "distance, " + product;
  if (row.X.terms == 2 || row.Y.terms == 2) return "point in a plane, " + product;
  const int x = row.X.term[0].shared % 4, y = row.Y.term[0].shared % 4;
  if (x == 2 && y == 2) return "constant angle, " + product;
  return (x == 2 || y == 2 ? "parallel axes, " : "no turn, ") + product;
}

class Analysis {
 public:
  Analysis(const System& system, const Equations<double>& equations) : system_(system), layout_(system.layout()), equations_(equations) {}

  ConstraintRow describe(int row) const {
    if (row >= layout_.norm_row(0)) return {system_.topology().bodies[index(row - layout_.norm_row(0))].name, 1, "unit Euler parameters"};
    if (row >= layout_.coupling_row(0)) {
      const Coupling& coupling = system_.topology().couplings[index(row - layout_.coupling_row(0))];
      return {coupling.name, 1, coupling.is_mimic ? "mimic" : "coupling"};
    }
    std::size_t pair = layout_.pair_row.size() - 1;
    while (layout_.pair_row[pair] > row) --pair;
    const int within = row - layout_.pair_row[pair];
    return {system_.topology().pairs[pair].name, within + 1, pair_row_kind(pair, within)};
  }

  /// Notes what a null space of Phi_q^T (m x defect) moves.
  void find_undetermined(const Eigen::MatrixXd& null_space, Redundancy* result) const {
    const auto moves = [&](int first, int last) {
      return last > first && null_space.middleRows(first, last - first).rowwise().norm().maxCoeff() > kTakesPart;
    };
    const Topology& topology = system_.topology();
    for (std::size_t k = 0; k < topology.pairs.size(); ++k) {
      if (!moves(layout_.pair_row[k], layout_.pair_end(static_cast<int>(k)))) continue;
      result->undetermined.push_back(topology.pairs[k].name);
      if (topology.pairs[k].friction_joint >= 0 && moves_normal_force(k, null_space))
        result->friction_chosen.push_back(topology.pairs[k].name);
    }
    for (std::size_t k = 0; k < topology.couplings.size(); ++k) {
      const int row = layout_.coupling_row(static_cast<int>(k));
      if (moves(row, row + 1)) result->undetermined.push_back(topology.couplings[k].name);
    }
  }

 private:
  static std::size_t index(int k) { return static_cast<std::size_t>(k); }

  std::string pair_row_kind(std::size_t pair, int within) const {
    const PairRows<double>& rows = equations_.rows(static_cast<int>(pair));
    if (rows.coincident && within < 3) return std::string("coincident points, ground ") + "xyz"[within];
    return product_kind(rows.products[index(within - (rows.coincident ? 3 : 0))]);
  }

  // All of a joint's rows enter its normal force, but in a plane and in a ball, whose pressure is the force alone.
  bool moves_normal_force(std::size_t k, const Eigen::MatrixXd& null_space) const {
    const bool plane = system_.topology().pairs[k].kind == PairKind::kPlanar || system_.topology().pairs[k].kind == PairKind::kTable;
    const int rows = plane ? 1 : layout_.pair_end(static_cast<int>(k)) - layout_.pair_row[k];
    return null_space.middleRows(layout_.pair_row[k], rows).rowwise().norm().maxCoeff() > kTakesPart;
  }

  const System& system_;
  const Layout& layout_;
  const Equations<double>& equations_;
};

}  // namespace

Eigen::MatrixXd constraint_jacobian(const System& system, Equations<double>* equations, const State<double>& state) {
  Linearization<double> d;
  d.resize(system.patterns());
  equations->linearize(state, &d);
  const Layout& layout = system.layout();
  const Sparsity& G_z = system.patterns().rate;
  Eigen::MatrixXd Phi_q = Eigen::MatrixXd::Zero(layout.m, layout.n);
  for (int row = 0; row < layout.m; ++row)
    for (int e = G_z.first(layout.lambda_column(row)); e < G_z.first(layout.lambda_column(row) + 1); ++e)
      if (G_z.column(e) < layout.n) Phi_q(row, G_z.column(e)) = d.rate[static_cast<std::size_t>(e)];
  return Phi_q;
}

Redundancy analyse_redundancy(const System& system, const Equations<double>& equations, const Eigen::MatrixXd& Phi_q) {
  Redundancy result;
  const Analysis analysis(system, equations);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> by_rows;
  by_rows.setThreshold(kRankTolerance);
  by_rows.compute(Phi_q.transpose());
  const Eigen::Index rank = by_rows.rank(), defect = Phi_q.rows() - rank;
  if (defect == 0) return result;
  for (Eigen::Index k = rank; k < Phi_q.rows(); ++k)
    result.rows.push_back(analysis.describe(static_cast<int>(by_rows.colsPermutation().indices()[k])));
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> by_columns(Phi_q);
  const Eigen::MatrixXd Q = by_columns.householderQ();
  analysis.find_undetermined(Q.rightCols(defect), &result);
  return result;
}

}  // namespace codesign
