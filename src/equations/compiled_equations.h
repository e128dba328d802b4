// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <memory>
#include <vector>

#include "description/expression.h"
#include "equations/equation_function.h"
#include "math/arrays.h"
#include "sparse/sparsity.h"
#include "system/state.h"

namespace codesign {

class CompiledSystem;
class CompressedJacobian;
template <class T>
class VariantInputs;
struct MassFactor;
struct CompiledFunction;
struct NumberedRecording;
struct SwitchOrigin;

/// The recorded equations of one design (EquationVariant): machine code where it can be made, else
/// a loop over the recorded operations. The results equal those of Formulas within rounding. T:
/// double, std::complex<double> (always by the loop) or Lanes<N>. No allocation after the first
/// evaluation of a variant; not thread-safe.
///
/// A recording holds one outcome of each decision. Every evaluation compares its decisions with
/// those of the variant that served last, then with the others that are known; a variant that is
/// missing is recorded.
template <class T>
class CompiledEquations {
 public:
  explicit CompiledEquations(const CompiledSystem& system,
                             EquationPart part = EquationPart::kMotion);
  CompiledEquations(CompiledEquations&&) noexcept;
  ~CompiledEquations();

  /// Takes the values of all named parameters; the constants are evaluated when a function is first
  /// called.
  void set_design(const std::vector<T>& parameters);
  const std::vector<T>& parameters() const { return parameters_; }
  /// With false machine code is neither made nor used: a few evaluations take less time than making
  /// it.
  void allow(bool machine_code);
  /// Begins again with the first variant.
  void use_first_variant();
  /// From now on the switches of the residual have the outcomes of this mode at every state, so
  /// that its formulas are smooth across their guards; doc/theory.md (17d). Not in signals and
  /// starts.
  void hold(const std::vector<bool>& mode);
  /// Ends hold(): each state decides.
  void release();
  /// The mode of a state: the outcomes that it decides.
  const std::vector<bool>& mode_of(const State<T>& state);
  /// The differences y - x of which the switches are the signs, and the numbers y; resized to their
  /// number in the mode.
  void switches(const State<T>& state, VectorX<T>* differences, VectorX<T>* right);
  /// Where the k-th switch of a mode was recorded, kept as long as the system; null if no variant
  /// of the mode has been used.
  const SwitchOrigin* switch_origin(const std::vector<bool>& mode, std::size_t k) const;
  /// The values of the study's expressions of signals in the residual, then the integrand g; for
  /// double. @param values resized.
  void expressions(const State<T>& state, VectorX<T>* values);
  /// For T = Lanes<N>: the directions of the time; zero without a call.
  void set_time_direction(const std::vector<double>& direction) { time_direction_ = direction; }

  /// The functions of Equations of the same name.
  void residual(const State<T>& state, VectorX<T>* G, T* g);
  void linearize(const State<T>& state, Linearization<T>* derivatives);
  void rates(const State<T>& state, VectorX<T>* G, T* g, Linearization<T>* derivatives);
  void constraint_errors(const State<T>& state, VectorX<T>* Phi, VectorX<T>* Phi_rate);
  /// body_energies(), for systems with a forest. @param bodies nine entries per body.
  void energies(const State<T>& state, VectorX<T>* sums, VectorX<T>* bodies);
  /// Sets z to the solution of G = 0, g, and the factors of G_z. @return false if the variant that
  /// serves has no kAccelerations; then z stays. @param factors resized to MassFactor::size() of
  /// mass_factor().
  bool accelerations(State<T>* state, T* g, std::vector<T>* factors);
  /// The pattern of those factors; null if the variant that serves has none.
  const MassFactor* mass_factor();

  /// The value of kTerminal or of a watched signal; and with its gradient. @param gradient
  /// overwritten.
  T signal(EquationFunction function, const State<T>& state);
  T signal(EquationFunction function, const State<T>& state, SparseGradient<T>* gradient);
  /// kIntegralResiduals or kTerminalResiduals. @param size number of terms.
  void residuals(EquationFunction function, const State<T>& state, std::size_t size,
                 VectorX<T>* residuals);

  /// Sets q and v to those of tree coordinates and their rates.
  void place(const VectorX<T>& theta, const VectorX<T>& theta_rate, State<T>* state);
  /// Sets State::turns to the joint positions of the state.
  void track_turns(State<T>* state);
  /// stuck_slips() at a state. @param accelerations, limits of their sizes.
  void stuck_slips(const State<T>& state, VectorX<T>* accelerations, VectorX<T>* limits);
  /// begin_bristles() at a state; other states stay.
  void begin_bristles(State<T>* state);
  /// The output of a controller at a sample, or its start: sample_controller().
  T sample(int controller, bool is_first, State<T>* state);

  /// The derivatives of one function along N directions of state and design, for T = Lanes<N> only.
  /// The directions of the design are the directions of the parameters given to set_design().
  /// @param turns State::turns. @param values of q, v, s and z. @param directions of the same
  /// vectors, N numbers side by side per entry.
  /// @param results one array per result in the order of EquationFunction, N numbers side by side
  /// per entry; then empty arrays.
  void tangents(EquationFunction function, double t, const std::vector<double>& turns,
                const In<double> (&values)[4], const In<double> (&directions)[4],
                const Out<double> (&results)[4]);

  /// Directions of q, v, s and z, N numbers side by side per entry, and where the derivatives of G
  /// and g along them go; then empty arrays.
  struct Pass {
    In<double> directions[4];
    Out<double> results[4];
  };
  /// The derivatives of the residual at one state along the directions of every pass, for T =
  /// Lanes<N> only. The design must not vary.
  /// @param along_time null, or a pass with zero directions whose first one becomes the time, if
  /// functions of time occur.
  /// @return whether they do.
  bool residual_tangents(const State<double>& state, const std::vector<Pass>& passes,
                         const Pass* along_time);

  // The next two functions exist for T = double only. The products by parameters are summed up
  // since set_design().

  /// Adds the derivatives of the sum of weights times results of a function by q and s, v and z at
  /// fixed parameters to `adjoint`, theory (18e): of kResidual, kLinearization, kConstraintErrors
  /// or kSwitches of EquationPart::kMotion, or of a sample of EquationPart::kStart.
  /// @param weights one array per result in the order of EquationFunction; then empty arrays.
  /// @param adjoint (q, s), v and z side by side; more entries are not touched.
  void add_transposed(EquationFunction function, const State<T>& state,
                      const In<double> (&weights)[4], Out<double> adjoint);
  /// Adds the derivatives of all these sums by the tuned parameters at fixed states. @param
  /// gradient p entries, order of Study::tuned.
  void add_gradient(Out<double> gradient);

 private:
  /// What of a function is evaluated: values (with tangents, for Lanes), tangents along given
  /// directions, or transposed products.
  enum class Mode { kValues, kSplit, kTransposed };
  /// Where a function is evaluated.
  struct Instant {
    EquationFunction function;
    Mode mode;
    double t;
    const std::vector<double>& turns;
  };

  /// The equations of the part in which a function is recorded: these, or others that are made when
  /// they are first needed.
  CompiledEquations& holder(EquationFunction function);
  EquationPart part_of(EquationFunction function) const;
  CompressedJacobian& compressed();
  /// @return `other` with this design.
  template <class Other>
  std::unique_ptr<Other> prepared(std::unique_ptr<Other> other) const;
  /// Calls visit for those others.
  template <class Visit>
  void for_each_other(const Visit& visit) const;
  /// Takes over one more of the variants that the system knows; false if there is none.
  bool adopt();
  /// Whether variants are chosen by the mode that is held.
  bool holds() const {
    return held_ && part_ != EquationPart::kSignals && part_ != EquationPart::kStart;
  }
  bool serves(std::size_t k) const { return !holds() || variants_[k].code().mode() == mode_; }
  /// The first decision of a variant that the point makes otherwise; -1 if the results are valid.
  /// Machine code does not tell which one, 0.
  template <class Run>
  int attempt(const Instant& instant, bool interpreted, const Run& run, VariantInputs<T>* variant);
  template <class Run>
  void evaluate(const Instant& instant, const Run& run);
  template <class Run>
  void add_variant(const Instant& instant, const Run& run);
  void run(EquationFunction function, double t, const std::vector<double>& turns,
           const In<T> (&state)[4], const Out<T> (&results)[4]);
  void run(EquationFunction function, const State<T>& at, const Out<T> (&results)[4]) {
    run(function, at.t, at.turns, {at.q, at.v, at.s, at.z}, results);
  }

  const CompiledSystem& system_;
  EquationPart part_;
  std::vector<T> parameters_;
  bool interpreted_ = false, held_ = false;
  std::vector<bool> mode_;                                                 ///< that is held
  std::vector<double> time_direction_;                                     ///< N entries, or empty
  std::array<std::unique_ptr<CompiledEquations>, kEquationParts> others_;  ///< see holder()
  /// for double, if the system compresses its Jacobian
  std::unique_ptr<CompressedJacobian> compressed_;
  std::vector<VariantInputs<T>> variants_;  ///< the first ones that the system knows, in its order
  std::size_t current_ = 0;                 ///< the variant that served last
  /// variants with products since set_design(), in the order of their first one
  std::vector<std::size_t> multiplied_;
  std::vector<T> entries_;   ///< workspace of signal() and track_turns()
  VectorX<T> s_;             ///< workspace of sample()
  VectorX<T> residual_;      ///< workspace of mode_of()
  LineVector slots_, rows_;  ///< workspace of the code
};

}  // namespace codesign
