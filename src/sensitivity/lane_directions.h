// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <new>
#include <vector>

#include "equations/compiled_system.h"
#include "integration/increment.h"
#include "math/arrays.h"
#include "math/scalar.h"
#include "system/state.h"

namespace codesign {

/// N directional derivatives of a vector: an N x size matrix with one column per component, in
/// memory aligned to cache lines.
template <int N>
class Directions : public Eigen::Map<Eigen::Matrix<double, N, Eigen::Dynamic>> {
 public:
  using Map = Eigen::Map<Eigen::Matrix<double, N, Eigen::Dynamic>>;
  using Vector = typename Lanes<N>::Vector;

  /// All zero.
  explicit Directions(Eigen::Index columns = 0) : Map(nullptr, N, 0) { resize(columns); }
  Directions(const Directions& other) : Map(nullptr, N, 0) { *this = other; }
  Directions& operator=(const Directions& other) {
    resize(other.cols());
    Map::operator=(other);
    return *this;
  }

  /// A change of the number of columns sets all entries to zero.
  void resize(Eigen::Index columns) {
    if (columns == this->cols()) return;
    numbers_.assign(to_index(N * columns), 0.0);
    new (static_cast<Map*>(this)) Map(numbers_.data(), N, columns);
  }

  /// The N derivatives of one component as a vector of the processor.
  Vector& vector(int column) { return *reinterpret_cast<Vector*>(this->data() + N * column); }
  const Vector& vector(int column) const {
    return *reinterpret_cast<const Vector*>(this->data() + N * column);
  }

  /// The derivatives of `count` components from the `first` on, N side by side for each.
  Span<double> part(int first, int count) {
    return Span<double>(numbers_).subspan(N * first, N * count);
  }
  Span<const double> part(int first, int count) const {
    return Span<const double>(numbers_).subspan(N * first, N * count);
  }

 private:
  LineVector numbers_;
};

/// The tuned parameters rho_first, ..., rho_(first+count-1), count <= N, each with one of N lanes.
template <int N>
struct LaneRange {
  int first = 0, count = 0;

  /// All named parameters (Study::parameters order), with the derivative 1 of rho_(first+k) in lane
  /// k. @param lanes overwritten, its memory is used again.
  void seed(const CompiledSystem& system, const std::vector<double>& parameters,
            std::vector<Lanes<N>>* lanes) const {
    lanes->assign(parameters.begin(), parameters.end());
    for (int k = 0; k < count; ++k) {
      const int tuned = system.study().tuned[to_index(first + k)];
      (*lanes)[to_index(tuned)].v[k] = 1.0;
    }
  }
  std::vector<Lanes<N>> seed(const CompiledSystem& system,
                             const std::vector<double>& parameters) const {
    std::vector<Lanes<N>> lanes;
    seed(system, parameters, &lanes);
    return lanes;
  }
};

/// The lanes `first` .. `first + value - 1` to be divided into groups; each group reserves
/// `reserved` further lanes for its own use.
struct LaneCount {
  int value = 0, reserved = 0, first = 0;
};

/// Divides lanes into groups of eight; a last group of four lanes or fewer is a Group<4>. Without a
/// LaneCount there is one lane per tuned parameter. Group<N> is constructed from (system,
/// LaneRange<N>, further arguments).
template <template <int> class Group>
class LaneGroups {
 public:
  template <class... Arguments>
  explicit LaneGroups(const CompiledSystem& system, const Arguments&... arguments)
      : LaneGroups(LaneCount{static_cast<int>(system.study().tuned.size())}, system, arguments...) {
  }
  template <class... Arguments>
  LaneGroups(LaneCount lanes, const CompiledSystem& system, const Arguments&... arguments) {
    const int end = lanes.first + lanes.value;
    int first = lanes.first;
    const int wide = 8 - lanes.reserved;
    for (; end - first > 4 - lanes.reserved; first += wide)
      wide_.push_back(std::make_unique<Group<8>>(
          system, LaneRange<8>{first, std::min(wide, end - first)}, arguments...));
    if (first < end)
      narrow_.push_back(
          std::make_unique<Group<4>>(system, LaneRange<4>{first, end - first}, arguments...));
  }

  template <class Action>
  void for_each(const Action& action) {
    for (auto& group : wide_) action(group.get());
    for (auto& group : narrow_) action(group.get());
  }

 private:
  std::vector<std::unique_ptr<Group<8>>> wide_;
  std::vector<std::unique_ptr<Group<4>>> narrow_;
};

/// Combines values and directional derivatives in a state of lanes. @param directions in the order
/// of IncrementLayout. @param state must have the sizes of `values`.
template <int N>
void load_lanes(const IncrementLayout& at, const State<double>& values,
                const Directions<N>& directions, State<Lanes<N>>* state) {
  const auto load = [&directions](const VectorX<double>& value, int first,
                                  VectorX<Lanes<N>>* lanes) {
    for (Eigen::Index k = 0; k < value.size(); ++k) {
      (*lanes)[k].a = value[k];
      (*lanes)[k].directions() = directions.col(first + k);
    }
  };
  state->t = values.t;
  state->turns = values.turns;
  load(values.q, at.x(), &state->q);
  load(values.s, at.s(), &state->s);
  load(values.v, at.v(), &state->v);
  load(values.z, at.z(), &state->z);
}

/// Sum of squares of `size` components from `first` on, for each direction.
template <int N>
Eigen::Array<double, N, 1> squared_norms(const Directions<N>& x, int first, int size) {
  Eigen::Array<double, N, 1> sum = Eigen::Array<double, N, 1>::Zero();
  for (int k = first; k < first + size; ++k) sum += x.col(k).array().square();
  return sum;
}

}  // namespace codesign
