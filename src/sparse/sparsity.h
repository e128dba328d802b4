// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SPARSE_SPARSITY_H_
#define MECHANISM_CODESIGN_SPARSE_SPARSITY_H_

#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "math/scalar.h"

namespace codesign {

/// The pattern of a sparse matrix in compressed-row form; column indices ascend within each row.
struct Sparsity {
  int rows = 0, columns = 0;
  std::vector<int> row_start, column_index;  ///< index of the first nonzero of each row (rows + 1 of them); column of each nonzero

  int nonzeros() const { return static_cast<int>(column_index.size()); }
  int first(int row) const { return row_start[static_cast<std::size_t>(row)]; }
  int column(int entry) const { return column_index[static_cast<std::size_t>(entry)]; }
};

/// One object for each group of variables that the equations are differentiated by: positions (q, s), velocities v, rates
/// z = (a, lambda, sigma); theory (14).
template <class X>
struct ByVariable {
  X position, velocity, rate;
};

/// Records which entries of the three matrices an assembly adds to, in order. It has the interface of AssemblySink.
class PatternRecorder {
 public:
  template <class T>
  void position(int row, int column, const T&) {
    calls_.position.emplace_back(row, column);
  }
  template <class T>
  void velocity(int row, int column, const T&) {
    calls_.velocity.emplace_back(row, column);
  }
  template <class T>
  void rate(int row, int column, const T&) {
    calls_.rate.emplace_back(row, column);
  }
  template <class T>
  void time(int, const T&) {}

  using Calls = std::vector<std::pair<int, int>>;
  const ByVariable<Calls>& calls() const { return calls_; }

  /// The pattern of one matrix from its recorded calls.
  /// @param slots gets, per call, the index of the nonzero that it adds to; its bitwise complement for the first call that touches it.
  static Sparsity build(const Calls& calls, int rows, int columns, std::vector<int>* slots);

 private:
  ByVariable<Calls> calls_;
};

/// The patterns of an assembly's matrices and where each of its calls adds to them.
struct AssemblyPlan {
  /// One row per equation of G, then one row for the integrand g of the objective.
  ByVariable<Sparsity> patterns;
  /// Per call, in order: its slot as PatternRecorder::build() gives it.
  ByVariable<std::vector<int>> slots;
};

/// The derivatives of the equations, theory (14): the nonzeros of three sparse matrices (position: G_q and G_s, velocity: G_v, rate: G_z),
/// and the partial derivative by time.
template <class T>
struct Linearization : ByVariable<std::vector<T>> {
  VectorX<T> time;  ///< G_t, then g_t; units of the rows per second

  void resize(const ByVariable<Sparsity>& patterns) {
    this->position.resize(patterns.position.column_index.size());
    this->velocity.resize(patterns.velocity.column_index.size());
    this->rate.resize(patterns.rate.column_index.size());
    time.setZero(patterns.rate.rows);
  }
};

#ifdef NDEBUG
constexpr bool kCheckAssembly = false;
#else
constexpr bool kCheckAssembly = true;
#endif

/// Adds the values of an assembly to a Linearization. The sequence of calls must equal the sequence recorded for `plan`.
/// @tparam checked whether each call is compared with the recorded row and column, as in debug builds.
template <class T, bool checked = kCheckAssembly>
class AssemblySink {
 public:
  AssemblySink(const AssemblyPlan& plan, Linearization<T>* values)
      : plan_(plan), slot_{plan.slots.position.data(), plan.slots.velocity.data(), plan.slots.rate.data()}, values_(values) {
    values->time.setZero();
  }

  // @throws std::logic_error if checked, for a call that was not recorded at this place of the sequence.
  void position(int row, int column, const T& x) {
    if constexpr (checked) check(slot_.position, plan_.slots.position, plan_.patterns.position, row, column);
    add(*slot_.position++, x, &values_->position);
  }
  void velocity(int row, int column, const T& x) {
    if constexpr (checked) check(slot_.velocity, plan_.slots.velocity, plan_.patterns.velocity, row, column);
    add(*slot_.velocity++, x, &values_->velocity);
  }
  void rate(int row, int column, const T& x) {
    if constexpr (checked) check(slot_.rate, plan_.slots.rate, plan_.patterns.rate, row, column);
    add(*slot_.rate++, x, &values_->rate);
  }
  void time(int row, const T& x) { values_->time[row] += x; }

  /// To be called at the end of the sequence. @throws std::logic_error if checked and recorded calls are missing.
  void finish() const {
    if constexpr (checked)
      if (slot_.position != end(plan_.slots.position) || slot_.velocity != end(plan_.slots.velocity) || slot_.rate != end(plan_.slots.rate))
        throw std::logic_error("assembly: fewer entries than were recorded");
  }

 private:
  static const int* end(const std::vector<int>& slots) { return slots.data() + slots.size(); }
  static void check(const int* next, const std::vector<int>& slots, const Sparsity& pattern, int row, int column) {
    if (next == end(slots)) throw std::logic_error("assembly: more entries than were recorded");
    const int slot = *next < 0 ? ~*next : *next;
    if (slot < pattern.first(row) || slot >= pattern.first(row + 1) || pattern.column(slot) != column)
      throw std::logic_error("assembly: entry (" + std::to_string(row) + ", " + std::to_string(column) +
                             ") was not recorded at this place");
  }

  // The first call that touches a slot sets it, so that the values need not be cleared before.
  static void add(int slot, const T& x, std::vector<T>* values) {
    if (slot < 0)
      (*values)[static_cast<std::size_t>(~slot)] = x;
    else
      (*values)[static_cast<std::size_t>(slot)] += x;
  }

  const AssemblyPlan& plan_;
  ByVariable<const int*> slot_;
  Linearization<T>* values_;
};

/// The sparse gradient of a scalar by positions, velocities, rates and time. A column may occur several times; its entries add up. clear()
/// keeps the memory.
template <class T>
struct SparseGradient {
  struct Entry {
    int column;
    T value;
  };
  using Entries = std::vector<Entry>;
  Entries position, velocity, rate;
  T time{0.0};

  void clear() {
    for (Entries* entries : {&position, &velocity, &rate}) entries->clear();
    time = T(0.0);
  }

  /// The entries up to a moment; see scale_from().
  struct Mark {
    std::size_t position, velocity, rate;
    T time;
  };
  Mark mark() const { return {position.size(), velocity.size(), rate.size(), time}; }

  /// Multiplies the values added after the mark by a factor.
  void scale_from(const Mark& mark, const T& factor) {
    scale(mark.position, factor, &position);
    scale(mark.velocity, factor, &velocity);
    scale(mark.rate, factor, &rate);
    time = mark.time + factor * (time - mark.time);
  }

 private:
  static void scale(std::size_t first, const T& factor, Entries* entries) {
    for (std::size_t k = first; k < entries->size(); ++k) (*entries)[k].value = (*entries)[k].value * factor;
  }
};

/// The gradient that a function appends to, or null if only the value is needed. The type is not deduced from the argument, so that nullptr
/// can be passed.
template <class T>
using OptionalGradient = std::common_type_t<SparseGradient<T>*>;

/// Adds factor times a gradient to one row of a PatternRecorder or AssemblySink.
template <class T, class Sink>
void add_row(int row, const T& factor, const SparseGradient<T>& gradient, Sink* sink) {
  for (const auto& e : gradient.position) sink->position(row, e.column, T(factor * e.value));
  for (const auto& e : gradient.velocity) sink->velocity(row, e.column, T(factor * e.value));
  for (const auto& e : gradient.rate) sink->rate(row, e.column, T(factor * e.value));
  sink->time(row, T(factor * gradient.time));
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SPARSE_SPARSITY_H_
