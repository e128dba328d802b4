// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/turn_follower.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "joints/joint_law.h"
#include "math/arrays.h"

namespace codesign {
namespace {

// [rad] An angle that misses its prediction by less changes in proportion to the way: the next part
// of the line may be twice as long, where the miss is four times as large at most. One that misses
// by more is looked at over half that part.
constexpr double kProportional = 0.1, kDoubtful = 0.8;
constexpr double kTurnOfBody = 2.1;
constexpr int kMostPoints = 10000;  // more only in an attempt that no error test accepts

/// A pair that constrains nothing has no scalar coordinate.
bool may_turn(const JointLaw& law) { return law.freedoms.turns > 0 && law.rows > 0; }

/// Keeps the entries that only one of two chains to a common body has.
void drop_pairs(std::vector<int>* columns) {
  std::vector<int> single;
  std::sort(columns->begin(), columns->end());
  for (std::size_t k = 0; k < columns->size(); ++k) {
    if (k + 1 < columns->size() && (*columns)[k] == (*columns)[k + 1])
      ++k;
    else
      single.push_back((*columns)[k]);
  }
  columns->swap(single);
}

}  // namespace

template <class T>
TurnFollower<T>::TurnFollower(const System& system) : system_(system) {
  const Layout& layout = system.layout();
  between_.resize(layout);
  for (int b = 0; b < layout.bodies; ++b)
    if (layout.is_free(b)) free_.push_back(layout.column(b) + 3);
  add_ways();
  slope_.resize(slots_.size());
}

template <class T>
void TurnFollower<T>::add_ways() {
  const std::vector<Pair>& pairs = system_.topology().pairs;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const int pair = static_cast<int>(p);
    const std::size_t before = slots_.size();
    if (!system_.layout().is_cut(pair)) continue;
    for (std::size_t e = 0; e < pairs[p].chain.size(); ++e)
      if (may_turn(system_.robot().joints[to_index(pairs[p].chain[e].joint)].law()))
        slots_.push_back(system_.layout().turn(pair, static_cast<int>(e)));
    if (slots_.size() == before) continue;
    Way way;
    note_ways(pairs[p].body_i, &way);
    note_ways(pairs[p].body_j, &way);
    drop_pairs(&way.turns);
    drop_pairs(&way.free);
    if (way.turns.empty() && way.free.empty()) continue;
    // The length of four changes is at most twice the largest of them.
    farthest_ = std::max(farthest_, static_cast<double>(way.turns.size()) +
                                        2.0 * kTurnOfBody * static_cast<double>(way.free.size()));
    ways_.push_back(std::move(way));
  }
}

/// Adds what turns a body, from the ground or a free body on.
template <class T>
void TurnFollower<T>::note_ways(int body, Way* way) const {
  const Layout& layout = system_.layout();
  for (; body >= 0 && !layout.is_free(body);) {
    const auto above = to_index(layout.forest.pair_above[to_index(body)]);
    const Pair& pair = system_.topology().pairs[above];
    int column = layout.column(body);
    for (const ChainElement& element : pair.chain) {
      const JointFreedoms& freedoms = system_.robot().joints[to_index(element.joint)].freedoms();
      for (int k = 0; k < freedoms.size(); ++k, ++column)
        if (freedoms.each[to_index(k)].turns) way->turns.push_back(column);
    }
    body = pair.body_i;
  }
  if (body >= 0) way->free.push_back(layout.column(body) + 3);
}

// A body turns by 4 asin(|p_1 - p_0|/2), which is less than 2.1 |p_1 - p_0| up to kSure, and never
// more than pi |p_1 - p_0|.
template <class T>
double TurnFollower<T>::longest_way(const State<T>& from, const State<T>& to) const {
  double longest = 0.0;
  for (const Way& way : ways_) {
    double sum = 0.0;
    for (int c : way.turns) sum += std::abs(value_of(to.q[c]) - value_of(from.q[c]));
    for (int c : way.free) {
      double square = 0.0;
      for (int k = c; k < c + 4; ++k) {
        const double change = value_of(to.q[k]) - value_of(from.q[k]);
        square += change * change;
      }
      sum += kTurnOfBody * std::sqrt(square);
    }
    longest = std::max(longest, sum);
  }
  return longest;
}

/// Sets q of between_ to a point of the line. Free bodies turn about a fixed axis at a constant
/// rate.
template <class T>
void TurnFollower<T>::place(const State<T>& from, const State<T>& to, double part) {
  between_.q = T(1.0 - part) * from.q + T(part) * to.q;
  for (int c : free_) {
    double product = 0.0, of_from = 0.0, of_to = 0.0;
    for (int k = c; k < c + 4; ++k) {
      const double a = value_of(from.q[k]), b = value_of(to.q[k]);
      product += a * b;
      of_from += a * a;
      of_to += b * b;
    }
    const double angle = std::acos(std::clamp(product / std::sqrt(of_from * of_to), -1.0, 1.0)),
                 sine = std::sin(angle);
    if (!(sine > 1e-9)) continue;  // no turn, or a whole one, whose axis is not known
    between_.q.template segment<4>(c) =
        T(std::sin((1.0 - part) * angle) / sine) * from.q.template segment<4>(c) +
        T(std::sin(part * angle) / sine) * to.q.template segment<4>(c);
  }
}

/// Counts the turns at a point of the line, from those in `to` on, where the angles are expected to
/// change by part * slope_. @returns the largest miss of this expectation [rad].
template <class T>
double TurnFollower<T>::look(double part, Equations<T>* equations, const State<T>& to) {
  between_.t = to.t;
  between_.turns = to.turns;
  for (std::size_t k = 0; k < slots_.size(); ++k)
    between_.turns[to_index(slots_[k])] += part * slope_[k];
  equations->track_turns(&between_);
  double miss = 0.0;
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    const auto slot = to_index(slots_[k]);
    const double change = between_.turns[slot] - to.turns[slot];
    miss = std::max(miss, std::abs(change - part * slope_[k]));
  }
  return miss;
}

// `to` keeps the references at the last point that was looked at, and gets at the end what the
// angles change by from there.
template <class T>
void TurnFollower<T>::count(const State<T>& from, double way, Equations<T>* equations,
                            State<T>* to) {
  if (!std::isfinite(way)) return;
  const double shortest = kSure * kTurnOfBody / (M_PI * way);
  double reached = 0.0, part = shortest;
  std::fill(slope_.begin(), slope_.end(), 0.0);
  place(from, *to, 0.0);
  look(0.0, equations, *to);
  for (int slot : slots_) to->turns[to_index(slot)] = between_.turns[to_index(slot)];
  for (int points = 0; reached + part < 1.0 && points < kMostPoints; ++points) {
    place(from, *to, reached + part);
    const double miss = look(part, equations, *to);
    if (part > shortest && miss > kDoubtful) {
      part = std::max(shortest, 0.5 * part);
      continue;
    }
    for (std::size_t k = 0; k < slots_.size(); ++k) {
      double& reference = to->turns[to_index(slots_[k])];
      slope_[k] = (between_.turns[to_index(slots_[k])] - reference) / part;
      reference += part * slope_[k];
    }
    const bool is_first = reached == 0.0;
    reached += part;
    if (!is_first && miss < kProportional) part *= 2.0;
  }
  for (std::size_t k = 0; k < slots_.size(); ++k)
    to->turns[to_index(slots_[k])] += (1.0 - reached) * slope_[k];
}

template class TurnFollower<double>;
template class TurnFollower<std::complex<double>>;

}  // namespace codesign
