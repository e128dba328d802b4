// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/determined_motion.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "mechanism/constants.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kRankOfMotions = 1e-9;
// Smaller eigenvalues of M, relative to the largest, count as zero.
constexpr double kSingular = 1e-12;
// Square of a radius of gyration [m^2]; smaller ones are rounding of the tool that wrote the file.
constexpr double kSmallestGyration = 1e-14;

bool lacks_inertia(const BodyConstants<double>& body) {
  if (!(body.mass > 0.0)) return true;
  const Eigen::Vector3d moments = principal_moments(body.J);
  return !(moments[0] > kSingular * moments[2]) || !(moments[0] > kSmallestGyration * body.mass);
}

/// The mass matrix in the tree's joint coordinates and the joint rates that loops and couplings
/// allow; doc/theory.md (14a).
class Motions {
 public:
  Motions(const CompiledSystem& system, const std::vector<double>& parameters,
          const Assembly& assembly, Equations<double>* equations)
      : system_(system),
        tree_(assembly.tree()),
        parameters_(parameters),
        theta_(assembly.theta()),
        equations_(equations) {
    find_independent();
    find_mass_matrix();
    find_allowed();
  }

  /// A motion without inertia, as one rate per independent coordinate; empty if there is none.
  Eigen::VectorXd undetermined() const {
    if (allowed_.cols() == 0) return {};
    const Eigen::MatrixXd scaled = scale_.asDiagonal() * allowed_;
    const SymmetricEigen eigen = symmetric_eigen(transposed_product(scaled, product(M_, scaled)));
    const Eigen::VectorXd& values = eigen.values;
    if (values[0] > kSingular * std::max(values[values.size() - 1], 0.0)) return {};
    return scale_.asDiagonal() * (allowed_ * eigen.vectors.col(0));
  }

  [[noreturn]] void refuse(const Eigen::VectorXd& motion) const {
    Eigen::Index largest = 0;
    const double size = motion.cwiseAbs().maxCoeff(&largest);
    std::string rates;
    for (Eigen::Index k = 0; k < motion.size(); ++k)
      if (std::abs(motion[k]) > 1e-6 * size)
        rates += (rates.empty() ? "" : ", ") + joint_of(coordinates_[to_index(k)]).name + ": " +
                 to_decimal(std::round(motion[k] / motion[largest] * 1e6) / 1e6);
    const int c = coordinates_[to_index(largest)];
    const LinkDescription& link = system_.robot().links[to_index(joint_of(c).child)];
    throw InputError(
        {link.inertial ? link.inertial->where : link.where, "<link name=\"" + link.name + "\">",
         "nothing with inertia resists the link " + direction(c) +
             ", so that this motion is not determined at the start",
         "rates of the joints that move: " + rates,
         "an <inertial> with mass, or with inertia in that direction; or a fixed joint"});
  }

 private:
  const JointDescription& joint_of(int coordinate) const {
    for (int k : tree_.joint_order) {
      const int first = tree_.offset[to_index(k)];
      if (coordinate >= first &&
          coordinate < first + system_.robot().joints[to_index(k)].freedoms().size())
        return system_.robot().joints[to_index(k)];
    }
    return system_.robot().joints.front();
  }

  std::vector<LinkMotion<double>> unit_motion(int c) const {
    return link_motions(system_.robot(), tree_, parameters_, theta_,
                        VectorX<double>(VectorX<double>::Unit(tree_.size, c)));
  }

  /// Sets state_.q, and v to the velocities for the unit rate of one coordinate.
  void place_unit_motion(int c, VectorX<double>* v) {
    state_coordinates(system_, tree_, equations_->constants(), unit_motion(c), theta_,
                      VectorX<double>(VectorX<double>::Unit(tree_.size, c)), &state_.q, v);
  }

  // Leaves out coordinates that move no body, and coordinates of folded joints that move the bodies
  // as other coordinates do.
  void find_independent() {
    Eigen::MatrixXd all(system_.layout().n, tree_.size);
    VectorX<double> v;
    for (int c = 0; c < tree_.size; ++c) {
      place_unit_motion(c, &v);
      const double size = v.norm();
      all.col(c) = size > 1e-12 ? Eigen::VectorXd(v / size)
                                : Eigen::VectorXd(Eigen::VectorXd::Zero(v.size()));
    }
    const PivotedColumns pivots = pivot_columns(all, kRankOfMotions);
    coordinates_.assign(pivots.order.begin(), pivots.order.begin() + pivots.rank);
    std::sort(coordinates_.begin(), coordinates_.end());
    V_.resize(all.rows(), pivots.rank);
    for (std::size_t k = 0; k < coordinates_.size(); ++k) {
      place_unit_motion(coordinates_[k], &v);
      V_.col(to_signed(k)) = v;
    }
  }

  // The block G_a of (14) in the independent coordinates: the bodies' M and every other term in a,
  // such as rotors.
  void find_mass_matrix() {
    const VectorX<double> q = state_.q;
    state_.resize(system_.layout());
    state_.q = q;
    state_.v.setZero();
    state_.z.setZero();
    const std::vector<Eigen::Triplet<double>> entries =
        acceleration_block(system_, equations_, state_, 0, system_.layout().n);
    Eigen::SparseMatrix<double> M(system_.layout().n, system_.layout().n);
    M.setFromTriplets(entries.begin(), entries.end());
    M_ = transposed_product(V_, M * V_);
    choose_scale();
  }

  // Scales M to a unit diagonal; a coordinate without inertia of its own gets the factor of the
  // lightest other coordinate.
  void choose_scale() {
    const Eigen::Index size = M_.rows();
    double lightest = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < size; ++k) {
      M_(k, k) = moved_inertia(k);
      if (M_(k, k) != 0.0) lightest = std::min(lightest, std::abs(M_(k, k)));
    }
    scale_.resize(size);
    for (Eigen::Index k = 0; k < size; ++k)
      scale_[k] = 1.0 / std::sqrt(M_(k, k) != 0.0           ? std::abs(M_(k, k))
                                  : std::isfinite(lightest) ? lightest
                                                            : 1.0);
  }

  double moved_inertia(Eigen::Index k) const {
    double mass = 0.0;
    const std::vector<LinkMotion<double>> motions = unit_motion(coordinates_[to_index(k)]);
    for (std::size_t b = 0; b < system_.topology().bodies.size(); ++b)
      if (motions[to_index(system_.topology().bodies[b].base_link)].omega.norm() > 0.0)
        mass += std::abs(equations_->constants().bodies[b].mass);
    return std::abs(M_(k, k)) > kSmallestGyration * mass ? M_(k, k) : 0.0;
  }

  // An orthonormal basis of the scaled joint rates that satisfy the rows of loops and couplings.
  void find_allowed() {
    const Eigen::Index size = M_.rows();
    Eigen::MatrixXd forbidden(system_.layout().m, size);
    VectorX<double> errors, rates, given;
    state_.v.setZero();
    equations_->constraint_errors(state_, &errors, &given);
    for (Eigen::Index k = 0; k < size; ++k) {
      state_.v = V_.col(k);
      equations_->constraint_errors(state_, &errors, &rates);
      forbidden.col(k) = (rates - given) * scale_[k];
    }
    const double rounding = 1e-12 * scale_.maxCoeff();
    forbidden =
        forbidden.unaryExpr([rounding](double x) { return std::abs(x) < rounding ? 0.0 : x; });
    allowed_ = orthogonal_complement(forbidden.transpose(), kRankOfMotions);
  }

  std::string direction(int c) const {
    const JointDescription& joint = joint_of(c);
    const std::vector<LinkMotion<double>> motions = unit_motion(c);
    const LinkMotion<double>&child = motions[to_index(joint.child)],
          &parent = motions[to_index(joint.parent)];
    const Vector3<double> turn = child.omega - parent.omega;
    const Vector3<double> axis = turn.norm() > 0.5 ? turn : child.velocity - parent.velocity;
    std::string text;
    for (int k = 0; k < 3; ++k)
      text += (k > 0 ? " " : "") + to_decimal(std::round(axis[k] * 1e6) / 1e6 + 0.0);
    return std::string(turn.norm() > 0.5 ? "turning about" : "sliding along") + " the axis (" +
           text + ") of joint '" + joint.name + "'";
  }

  const CompiledSystem& system_;
  const TreeLayout& tree_;
  const std::vector<double>& parameters_;
  VectorX<double> theta_;
  Equations<double>* equations_;
  State<double> state_;
  std::vector<int> coordinates_;  ///< the independent tree coordinates, ascending
  Eigen::MatrixXd V_;             ///< n x coordinates: velocities of the bodies for unit rates
  Eigen::MatrixXd M_;             ///< V^T M V
  Eigen::VectorXd scale_;         ///< diagonal of D in (14a)
  Eigen::MatrixXd allowed_;       ///< N of (14a): orthonormal columns, in scaled coordinates
};

}  // namespace

std::vector<Eigen::Triplet<double>> acceleration_block(const CompiledSystem& system,
                                                       Equations<double>* equations,
                                                       const State<double>& state, int first,
                                                       int count) {
  Linearization<double> d;
  d.resize(system.patterns());
  equations->linearize_rates(state, &d);
  const Sparsity& G_z = system.patterns().rate;
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < count; ++row)
    for (int e = G_z.first(first + row); e < G_z.first(first + row + 1); ++e)
      if (G_z.column(e) < system.layout().n)
        entries.emplace_back(row, G_z.column(e), d.rate[to_index(e)]);
  return entries;
}

SparseMatrix constraint_jacobian(const CompiledSystem& system, Equations<double>* equations,
                                 const State<double>& state) {
  const Layout& layout = system.layout();
  const std::vector<Eigen::Triplet<double>> entries =
      acceleration_block(system, equations, state, layout.lambda_column(0), layout.constraints());
  SparseMatrix Phi_q(layout.constraints(), layout.n);
  Phi_q.setFromTriplets(entries.begin(), entries.end());
  return Phi_q;
}

void require_determined_motion(const CompiledSystem& system, const std::vector<double>& parameters,
                               const Assembly& assembly, Equations<double>* equations) {
  const std::vector<BodyConstants<double>>& bodies = equations->constants().bodies;
  if (std::none_of(bodies.begin(), bodies.end(), lacks_inertia)) return;
  const Motions motions(system, parameters, assembly, equations);
  const Eigen::VectorXd motion = motions.undetermined();
  if (motion.size() > 0) motions.refuse(motion);
}

void require_free_drives(const CompiledSystem& system, const std::vector<double>& parameters,
                         const Assembly& assembly, const Equations<double>& equations) {
  constexpr double kMoves = 1e-6;  // least rate of a joint, relative to all rates of a motion
  const std::vector<Coupling>& couplings = system.topology().couplings;
  const LoopJacobian& loops = assembly.loops();
  Eigen::MatrixXd scaled;
  // The drives are the last rows; each is compared with all rows before it.
  for (std::size_t k = 0; k < couplings.size(); ++k) {
    if (couplings[k].motion < 0) continue;
    if (scaled.size() == 0) {
      const SparseMatrix J = loops.evaluate(parameters, assembly.theta(), equations);
      const LoopScales scales = loops.scales(J, equations);
      scaled = scales.rows.asDiagonal() * J * scales.columns.asDiagonal();
    }
    const int row = loops.first_coupling_row() + static_cast<int>(k);
    const Eigen::MatrixXd allowed = orthogonal_complement(scaled.topRows(row).transpose(), kMoves);
    if (allowed.cols() > 0 && product(scaled.row(row), allowed).norm() > kMoves) continue;
    throw InputError({couplings[k].where, couplings[k].element(),
                      "the loops, the couplings and the other motions that are given determine the "
                      "motion of this joint already, at least at the start",
                      couplings[k].name,
                      "motions of at most as many joints as there are degrees of freedom, from a "
                      "start that is not singular"});
  }
}

}  // namespace codesign
