// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_H_

#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "codegen/traced.h"
#include "control/controller_constants.h"
#include "equations/compiled_equations.h"
#include "equations/contact_friction.h"
#include "equations/inverse_dynamics.h"
#include "equations/power_kind.h"
#include "equations/reaction_axis.h"
#include "equations/spring_end.h"
#include "equations/state.h"
#include "equations/system.h"
#include "forces/bristle_law.h"
#include "forces/normal_force.h"
#include "forces/spring_damper.h"
#include "joints/coordinate_load.h"
#include "joints/pair_motion.h"
#include "mechanism/constants.h"
#include "sparse/sparsity.h"

namespace codesign {

/// A friction law's state at one instant.
template <class T>
struct FrictionState {
  T velocity{0.0};  ///< of the child along or about the axis
  T normal{0.0};    ///< N [N]
  T load{0.0};      ///< that the joint exerts against the motion, S(v) N [N or N m]; the child feels -load
};

/// Whole turns are counted with values alone; while equations are recorded, these come with each evaluation.
template <class T>
using TurnReference = std::conditional_t<std::is_same_v<T, Traced>, Traced, double>;

/// How a rotor's carrier moves about the rotor's axis u; theory (9a).
template <class T>
struct RotorMotion {
  Vector3<T> axis;                                 ///< u, in the carrier's axes
  T ratio{1.0}, coupling{0.0};                     ///< n, n J_r
  T carrier_rate{0.0}, carrier_acceleration{0.0};  ///< omega . u and omega' . u of the carrier
  Vector3<T> swing = Vector3<T>::Zero();           ///< omega x u, in the carrier's axes
};

/// A constant wrench at one design.
template <class T>
struct ConstantWrench {
  Vector3<T> force, torque;  ///< in the root's axes; of one that turns in the body's, with the torque about the centre of mass
  Vector3<T> point;          ///< in body coordinates [m]
};

/// The equations of motion of one design, with the scratch memory to evaluate them; doc/theory.md (14):
///   rows 0..n:      M a + Phi_q^T lambda - Q - Q_Af = 0
///   rows n..n+m:    Phi_q a + (Phi_q v)_q v = 0
///   rows n+m..:     sigma - s' = 0, integrals of controllers, then states of friction laws
/// T: double, std::complex<double> or Lanes<N>; the same code gives values and every derivative, and with Traced what is compiled for one
/// mechanism and runs in its place wherever it can. No allocation once warm; not thread-safe.
template <class T>
class Equations {
 public:
  explicit Equations(const System& system);

  /// Evaluates all constants at `parameters` (all named parameters). Allocates.
  void set_design(const std::vector<T>& parameters);
  const Constants<T>& constants() const { return constants_; }
  const std::vector<T>& parameters() const { return parameters_; }
  const PairRows<T>& rows(int pair) const { return rows_[static_cast<std::size_t>(pair)]; }
  /// A controller's setpoint at the loaded state's time.
  T setpoint(int controller) const { return controllers_[static_cast<std::size_t>(controller)].setpoint.at(state_->t).value; }

  /// Residual G (columns() rows) and the objective's integrand g at a state.
  void residual(const State<T>& state, VectorX<T>* G, T* g);

  /// Derivatives of G and g, on System::patterns().
  void linearize(const State<T>& state, Linearization<T>* derivatives);

  /// What runs in place of these functions where it can.
  CompiledEquationsOf<T>& compiled() { return compiled_; }
  void residual_by_formulas(const State<T>& state, VectorX<T>* G, T* g);
  void linearize_by_formulas(const State<T>& state, Linearization<T>* derivatives);
  void constraint_errors_by_formulas(const VectorX<T>& q, const VectorX<T>& v, VectorX<T>* Phi, VectorX<T>* Phi_rate);

  /// Terminal objective terms w at a state, with their gradient if asked for.
  T terminal(const State<T>& state, SparseGradient<T>* gradient);

  /// Value of a signal at a state, with its gradient if asked for.
  T signal(const Signal& signal, const State<T>& state, SparseGradient<T>* gradient = nullptr);

  /// Constraint values Phi(q) (m rows) and rates Phi_q v.
  void constraint_errors(const VectorX<T>& q, const VectorX<T>& v, VectorX<T>* Phi, VectorX<T>* Phi_rate);

  /// The same of one pair's rows, for bodies that move as given; the ground is a body at rest.
  void pair_errors(int pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j, T* errors, T* rates) const;

  /// Counts whole turns: positions of turning joints are continued from the value nearest to these. One per pair and chain element; where
  /// reactions are shared, then one list more, 1 for each row that is dropped and 0 for each that could be.
  std::vector<std::vector<TurnReference<T>>>& turn_references() {
    ++version_;
    return turn_references_;
  }
  const std::vector<std::vector<TurnReference<T>>>& turn_references() const { return turn_references_; }
  /// Makes the present positions the references.
  void track_turns(const State<T>& state);

  /// Samplers used by the observer; the state must have been loaded by load().
  void load(const State<T>& state);
  const CoordinateMotion<T>& coordinate(int pair, int element, CoordinateDetail detail = CoordinateDetail::kAll) const;
  FrictionState<T> friction(int pair, int element);
  /// Isotropic friction of a pair among System::contacts().
  ContactFriction<T> contact(int pair, CoordinateDetail detail = CoordinateDetail::kGradient) const;
  /// The k-th spring-damper of the description.
  SpringForce<T> spring(std::size_t k) const;
  T effort(int pair, int element);
  /// Mechanical energy [J], and the power [W] that goes into the mechanism, with their gradients if asked for; theory (14b), (14c).
  T kinetic_energy(SparseGradient<T>* gradient) const;
  T potential_energy(SparseGradient<T>* gradient) const;
  T power(PowerKind kind, SparseGradient<T>* gradient);
  /// Of one joint: a pair and its chain element.
  T joint_power(PowerKind kind, int pair, int element, SparseGradient<T>* gradient);
  T controller_output(int controller, SparseGradient<T>* gradient);
  T controller_error(int controller, SparseGradient<T>* gradient);
  const BodyKinematics<T>& body(int index) const { return kinematics_[static_cast<std::size_t>(index < 0 ? layout_.bodies : index)]; }
  /// Reaction force and torque on the child in the parent's joint axes, as far as the pair constrains them.
  void reaction(int pair, Vector3<T>* F, Vector3<T>* torque) const;
  /// The share of the multipliers in a reaction signal; theory (11a).
  T multiplier_reaction(const SignalReference& term);

  /// Assembles all derivatives through `sink.position(row, column, x)`, `sink.velocity(...)`, `sink.rate(...)` and `sink.time(row, x)`.
  template <class Sink>
  void assemble(Sink* sink);

 private:
  template <class Sink>
  void assemble_pair(std::size_t k, Sink* sink);
  template <class Sink>
  void assemble_product(int pair, const ProductRow<T>& product, const PairMotion<T>& shared, int row, Sink* sink);
  template <class Sink>
  void assemble_coupling(std::size_t k, Sink* sink);
  template <class Sink>
  void assemble_body(std::size_t b, Sink* sink);
  template <class Sink>
  void assemble_load(const JointLoad& load, Sink* sink);
  /// Adds (J^T load)_q of a load along a coordinate.
  template <class Sink>
  void assemble_load_curvature(int pair, const CoordinateConstants<T>& coordinate, const T& load, Sink* sink);
  template <class Sink>
  void assemble_contact(int pair, Sink* sink);
  template <class Sink>
  void assemble_bristle(const BristleContact& contact, Sink* sink);
  template <class Sink>
  void assemble_spring(std::size_t k, Sink* sink);
  template <class Sink>
  void assemble_link_load(std::size_t k, Sink* sink);
  template <class Sink>
  void assemble_rotor(const Rotor& rotor, Sink* sink);
  template <class Sink>
  void assemble_rotor_moment(const Rotor& rotor, const RotorMotion<T>& m, Sink* sink);
  template <class Sink>
  void assemble_states(Sink* sink);
  template <class Sink>
  void assemble_objective(Sink* sink);

  // How redundant rows share reactions; theory (23).
  void load_sharing();
  void sharing_residual(VectorX<T>* G);
  void share_pair(int k, VectorX<T>* G);
  void share_coupling(int k, VectorX<T>* G);
  /// The equations of one row, of which the displacements w make `given` = Phi_q w.
  void share_row(int row, const T& given, VectorX<T>* G) const;
  template <class Sink>
  void assemble_sharing(Sink* sink);
  template <class Sink>
  void assemble_shared_pair(int k, Sink* sink);
  template <class Sink>
  void assemble_shared_products(int k, Sink* sink);
  template <class Sink>
  void assemble_shared_coupling(int k, Sink* sink);
  /// What does not depend on Phi_q.
  template <class Sink>
  void assemble_shared_row(int row, Sink* sink) const;
  /// Derivatives of Phi_q w of a row by one coordinate of a body, and by its displacement.
  template <class Sink>
  void assemble_given(int row, int body, int local, const T& by_q, const T& by_w, bool moves_q, Sink* sink) const;
  /// 1 for a row that is dropped, 0 for one that holds.
  T dropped(int row) const;
  const BodyKinematics<T>& displaced(int body) const { return displaced_[static_cast<std::size_t>(body < 0 ? layout_.bodies : body)]; }
  BodyLoad<T>* shared_load_on(int body) { return body < 0 ? nullptr : &shared_loads_[static_cast<std::size_t>(body)]; }

  void pair_residual(std::size_t k, VectorX<T>* G);
  void coupling_residual(std::size_t k, VectorX<T>* G);
  void coupling_error(std::size_t k, VectorX<T>* Phi, VectorX<T>* Phi_rate);
  void body_residual(std::size_t b, VectorX<T>* G);
  void load_residual(const JointLoad& load, VectorX<T>* G);
  void contact_residual(int pair, VectorX<T>* G);
  void bristle_residual(const BristleContact& contact, VectorX<T>* G);
  ContactSlip<T> bristle_slip(const BristleContact& contact, CoordinateDetail detail) const;
  /// The body whose turning the deflections follow, omega x zeta in their rate, though their axes do not; -1 if none.
  int bristle_carrier(const BristleContact& contact) const;
  Vector3<T> bristle_turn(const BristleContact& contact) const;
  void append_bristle_slip(const BristleContact& contact, const ContactSlip<T>& slip, const Vector3<T>& by_u,
                           SparseGradient<T>* gradient) const;
  void append_bristle_states(const BristleContact& contact, const Vector3<T>& by_zeta, const T& by_dwell,
                             SparseGradient<T>* gradient) const;
  /// Gradient of factor . omega of a body.
  void append_spin(int body, const Vector3<T>& factor, SparseGradient<T>* gradient) const;
  void add_spring_load(std::size_t k, const SpringForce<T>& force);
  std::array<internal::SpringEnd<T>, 2> spring_ends(std::size_t k) const;
  void set_constant_loads();
  /// Of the study's constant loads on one coordinate.
  T constant_effort(const JointLoad& load) const;
  void add_link_load(std::size_t k);
  void link_load_residual(std::size_t k, VectorX<T>* G);
  RotorMotion<T> rotor_motion(const Rotor& rotor) const;
  void rotor_residual(const Rotor& rotor, VectorX<T>* G) const;
  /// What the rotor takes over the gear, against its joint's coordinate.
  T rotor_load(const Rotor& rotor, SparseGradient<T>* gradient) const;
  T rotor_energy(const Rotor& rotor, SparseGradient<T>* gradient) const;
  T spring_energy(std::size_t k, SparseGradient<T>* gradient) const;
  T joint_energy(const JointLoad& load, SparseGradient<T>* gradient) const;
  /// Power that goes in over one coordinate.
  T load_power(PowerKind kind, const JointLoad& load, SparseGradient<T>* gradient);
  /// What a kind contributes to joint_load().
  T load_of(PowerKind kind, const JointLoad& load, const CoordinateMotion<T>& motion, SparseGradient<T>* gradient);
  T contact_power(int pair, SparseGradient<T>* gradient);
  T spring_power(std::size_t k, SparseGradient<T>* gradient) const;
  T link_load_power(std::size_t k, SparseGradient<T>* gradient) const;
  /// Scalar load along a coordinate, positive against it; its gradient is appended.
  T joint_load(const JointLoad& load, const CoordinateMotion<T>& motion, SparseGradient<T>* gradient);
  NormalForce<T> normal_force(int pair) const;
  T reaction_friction(int pair, int element, const CoordinateMotion<T>& motion, SparseGradient<T>* gradient, FrictionState<T>* state);
  T passive_load(int pair, int element, const JointLoad& load, const CoordinateMotion<T>& motion, SparseGradient<T>* gradient) const;
  /// What the controllers of a load apply, within the effort limit if that holds.
  T applied_effort(const JointLoad& load, SparseGradient<T>* gradient);
  /// Load of the stops, positive against the coordinate. @param dissipation of them, in place of the study's; 0: their elasticity alone.
  T stop_load(const JointLoad& load, const CoordinateMotion<T>& motion, double dissipation, SparseGradient<T>* gradient) const;
  /// What their load is more than their elasticity.
  T stop_dissipation(const JointLoad& load, const CoordinateMotion<T>& motion, SparseGradient<T>* gradient) const;
  void append_normal_gradient(int pair, const Vector3<T>& F, const Vector3<T>& torque, const T& factor, SparseGradient<T>* gradient) const;
  void append_local(int pair, const LocalRow<T>& row, const T& factor, bool with_r, typename SparseGradient<T>::Entries* entries) const;
  void append_acceleration(int pair, int element, const CoordinateMotion<T>& motion, const T& factor, SparseGradient<T>* gradient) const;
  /// Gradient of a body's angular velocity along an axis that it carries.
  void append_body_rate(int body, const Vector3<T>& axis, const T& factor, SparseGradient<T>* gradient) const;
  /// Gradient of a coordinate's rate.
  void append_rate(int pair, int element, const CoordinateMotion<T>& motion, const T& factor, SparseGradient<T>* gradient) const;
  static typename SparseGradient<T>::Mark mark(const SparseGradient<T>* gradient) {
    return gradient ? gradient->mark() : typename SparseGradient<T>::Mark{0, 0, 0, T(0.0)};
  }
  bool slip_moves_r(int pair, std::size_t k) const;
  void append_slip_rate(int pair, const ContactFriction<T>& contact, std::size_t k, const T& factor, SparseGradient<T>* gradient) const;
  /// Gradient of the load against the k-th slip coordinate.
  void append_contact_load(int pair, const ContactFriction<T>& contact, std::size_t k, const T& factor, SparseGradient<T>* gradient) const;
  T term_value(const SignalReference& term, const T& factor, SparseGradient<T>* gradient);
  T joint_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient);
  T load_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient);
  T contact_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient);
  T link_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient);
  T orientation_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient);
  T energy_or_power(const SignalReference& term, SparseGradient<T>* gradient);

  // What a joint exerts on its child; theory (11a).
  ReactionAxis<T> reaction_axis(const SignalReference& term) const;
  T reaction_term(const SignalReference& term, const T& factor, SparseGradient<T>* gradient);
  T constraint_reaction(const ReactionAxis<T>& axis, SparseGradient<T>* gradient) const;
  T product_reaction(const ReactionAxis<T>& axis, const ProductRow<T>& product, int row, SparseGradient<T>* gradient) const;
  T coordinate_reaction(const ReactionAxis<T>& axis, SparseGradient<T>* gradient);
  T rotor_reaction(const ReactionAxis<T>& axis, SparseGradient<T>* gradient) const;
  T coupling_reaction(const ReactionAxis<T>& axis, SparseGradient<T>* gradient) const;
  T contact_reaction(const ReactionAxis<T>& axis, SparseGradient<T>* gradient) const;
  /// Of a load along a coordinate of the joint. @param own where the load's own gradient begins.
  T load_reaction(const ReactionAxis<T>& axis, const CoordinateConstants<T>& coordinate, const LocalRow<T>& J, const T& load,
                  const typename SparseGradient<T>::Mark& own, SparseGradient<T>* gradient) const;

  T signal_value(const Signal& signal, const T& factor, SparseGradient<T>* gradient);
  T objective_terms(const std::vector<ResolvedTerm>& terms, const std::vector<T>& weights, const std::vector<Reference<T>>& references,
                    SparseGradient<T>* gradient);

  T controller_error_rate(int controller, const T& factor, SparseGradient<T>* gradient);
  /// p e + i s + d e'.
  T pid(int controller, SparseGradient<T>* gradient);
  /// Load of the driven joint's tree; fills by_acceleration_ with the gradient.
  T inverse_dynamics(int controller, const T* accelerations, SparseGradient<T>* gradient);
  T computed_torque(int controller, SparseGradient<T>* gradient);
  T wanted_acceleration(int controller, SparseGradient<T>* gradient);
  T state_feedback(int controller, SparseGradient<T>* gradient);
  T shaped_input(int controller, SparseGradient<T>* gradient);

  /// Global column of a local coordinate of a pair, or -1 on the ground.
  int column(int pair, int local) const { return columns_[static_cast<std::size_t>(pair)][static_cast<std::size_t>(local)]; }
  const CoordinateConstants<T>& coordinate_constants(int pair, int element) const {
    return constants_.pairs[static_cast<std::size_t>(pair)].coordinates[static_cast<std::size_t>(element)];
  }
  bool coordinate_moves_r(int pair, int element) const;
  /// What to add to a position so that it continues its reference.
  T whole_turns(int pair, int element, const T& position) const;
  BodyLoad<T>* load_on(int body) { return body < 0 ? nullptr : &loads_[static_cast<std::size_t>(body)]; }
  T coordinate_value(int pair, int element) const;

  const System& system_;
  const Layout& layout_;
  std::vector<T> parameters_;
  Constants<T> constants_;
  std::vector<PairRows<T>> rows_;
  std::vector<std::array<int, kLocalSize>> columns_;  ///< of each pair's local coordinates
  std::vector<ControllerConstants<T>> controllers_;
  std::vector<InverseDynamics<T>> inverse_dynamics_;  ///< one per controller
  /// Of the nodes of one controller's tree; rates where rotors need them.
  std::vector<T> accelerations_, by_acceleration_, rates_, by_rate_;
  std::vector<T> integral_weights_, terminal_weights_;
  std::vector<Reference<T>> integral_references_, terminal_references_;
  std::vector<T> efforts_;                   ///< of Study::loads
  std::vector<ConstantWrench<T>> wrenches_;  ///< of System::link_loads()
  Vector3<T> gravity_;
  const State<T>* state_ = nullptr;
  State<T> constraint_state_;                  ///< scratch of constraint_errors()
  std::vector<BodyKinematics<T>> kinematics_;  ///< the ground last
  std::vector<BodyLoad<T>> loads_;             ///< multiplier loads per body
  std::vector<BodyKinematics<T>> displaced_;   ///< bodies at rest, with displacements w as accelerations; the ground last
  std::vector<BodyLoad<T>> shared_loads_;      ///< of eta, per body

  /// A coordinate's motion, kept for the several that ask for it at the same state.
  struct KnownCoordinate {
    std::uint64_t version = 0;
    CoordinateDetail detail = CoordinateDetail::kRate;
    CoordinateMotion<T> motion;
  };
  mutable std::vector<std::vector<KnownCoordinate>> coordinates_;  ///< per pair and chain element
  std::uint64_t version_ = 0;                                      ///< of what coordinates depend on
  std::vector<std::vector<TurnReference<T>>> turn_references_;
  SparseGradient<T> gradient_, objective_gradient_;
  CompiledEquationsOf<T> compiled_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_H_
