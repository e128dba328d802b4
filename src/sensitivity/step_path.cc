// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/step_path.h"

#include <algorithm>
#include <utility>

#include "math/arrays.h"

namespace codesign {
namespace {

constexpr int kMemory = 32000000;  // [bytes]
constexpr int kFewest = 16;        // points that are stored in any case

int points_in_memory(const Layout& layout) {
  const int numbers = 1 + 2 * layout.n + layout.states + layout.columns();
  return std::max(kFewest, kMemory / (static_cast<int>(sizeof(double)) * numbers));
}

}  // namespace

StepPath::StepPath(const Layout& layout, int most)
    : most_(to_index(most > 0 ? most : points_in_memory(layout))) {}

void StepPath::clear() {
  sizes_.clear();
  starts_.clear();
  tableaus_.clear();
  count_ = 0;
  stride_ = 1;
}

void StepPath::append(double h, const RosenbrockTableau& tableau, const State<double>& state,
                      double next) {
  const int k = size();
  sizes_.push_back(h);
  starts_.push_back(next);
  tableaus_.push_back(&tableau);
  if (k % stride_ != 0) return;
  if (count_ >= most_) thin_out();
  if (k % stride_ == 0) push(k, state);
}

// Doubles the number of points that memory is allocated for, so that a later run with a few more
// steps needs none. There are at most twice as many as the caller asks for.
void StepPath::grow(const State<double>& state) {
  const std::size_t size = kept_.size(),
                    wanted = std::min(std::max(std::size_t{kFewest}, 2 * size), 2 * most_);
  kept_.resize(std::max(size + 1, wanted));
  for (std::size_t k = size; k < kept_.size(); ++k) {
    kept_[k].numbers.reserve(
        to_index(1 + state.q.size() + state.v.size() + state.s.size() + state.z.size()));
    kept_[k].turns.reserve(state.turns.size());
  }
}

void StepPath::push(int k, const State<double>& state) {
  if (count_ == kept_.size()) grow(state);
  Kept& kept = kept_[count_++];
  kept.k = k;
  kept.numbers.clear();
  kept.numbers.push_back(state.t);
  for (const VectorX<double>* part : {&state.q, &state.v, &state.s, &state.z})
    kept.numbers.insert(kept.numbers.end(), part->data(), part->data() + part->size());
  kept.turns = state.turns;
}

void StepPath::thin_out() {
  stride_ *= 2;
  std::size_t count = 0;
  for (std::size_t i = 0; i < count_; ++i)
    if (kept_[i].k % stride_ == 0) std::swap(kept_[count++], kept_[i]);
  count_ = count;
}

int StepPath::kept_before(int k) const {
  const auto end = kept_.begin() + to_signed(count_);
  return std::prev(std::upper_bound(kept_.begin(), end, k,
                                    [](int number, const Kept& kept) { return number < kept.k; }))
      ->k;
}

void StepPath::point(int k, State<double>* point) const {
  const auto end = kept_.begin() + to_signed(count_);
  const Kept& kept = *std::lower_bound(kept_.begin(), end, k,
                                       [](const Kept& one, int number) { return one.k < number; });
  const double* from = kept.numbers.data();
  State<double>& state = *point;
  state.t = *from++;
  for (VectorX<double>* part : {&state.q, &state.v, &state.s, &state.z}) {
    *part = Eigen::Map<const Eigen::VectorXd>(from, part->size());
    from += part->size();
  }
  state.turns = kept.turns;
}

// Uses half of the free memory, so that points between the stored ones can be stored later.
int StepPath::make_room(int from, int to) {
  while (stride_ > 1 && kept_[count_ - 1].k > from) --count_;
  const std::size_t all = 2 * most_, free = all > count_ ? (all - count_) / 2 : 0;
  const int places = std::max(1, static_cast<int>(free));
  return (to - from + places - 1) / places;
}

void StepPath::keep(int k, const State<double>& point) { push(k, point); }

}  // namespace codesign
