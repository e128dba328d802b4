// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/posture_list.h"

#include <algorithm>

#include "assembly/loop_turns.h"
#include "assembly/posture_walk.h"
#include "assembly/tree_loops.h"
#include "equations/compiled_system.h"
#include "equations/turn_follower.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// A position that is solved for is off a singular one by the square root of its tolerance.
constexpr double kSingularPosture = 1e-5;
constexpr double kLanding = 0.2;  // [rad or m] from the last solution before a singular posture
// Of the way, so that no step ends at a posture that was left out, whatever their number.
constexpr double kGolden = 0.6180339887498949;

}  // namespace

void PostureList::begin(const StartDesign& design, const Posture& posture,
                        const State<double>& state) {
  regular_.reset();
  usual_rank_ = 0;
  add(posture, state, is_singular(design, posture));
}

void PostureList::add(const Posture& posture, const State<double>& state, bool is_singular) {
  is_singular_ = is_singular;
  if (!is_singular) regular_ = Regular{posture.theta, posture.number, state};
}

/// The number of coordinates that the loops determine, of those that are not given.
std::size_t PostureList::rank(const StartDesign& design, const Posture& posture) {
  return closure_.dependent(design, posture, LoopRows::kEnforced, kSingularPosture).size();
}

bool PostureList::is_singular(const StartDesign& design, const Posture& posture) {
  const std::size_t found = rank(design, posture);
  usual_rank_ = std::max(usual_rank_, found);
  return found < usual_rank_;
}

/// The joints of the list with their positions in this posture: crank = 3.14159.
std::string PostureList::text(const std::vector<double>& parameters, double number) const {
  std::string text;
  for (const InitialJointState& initial : loops_.system.study().initial_state) {
    if (initial.positions.empty()) continue;
    const Quantity& position = initial.positions[static_cast<std::size_t>(number)];
    text += (text.empty() ? "" : ", ") + initial.joint + " = " + readable(position.at(parameters));
  }
  return text;
}

void PostureList::warn_of_singular(const std::vector<double>& parameters, double number,
                                   bool has_forces, Warnings* warnings) const {
  warnings->push_back(
      {"singular_posture",
       "posture " + readable(number) + " (" + text(parameters, number) +
           ") is singular: it is a dead centre, or several motions meet there, so that the given "
           "positions do not determine how the mechanism moves on" +
           (has_forces ? ""
                       : ", and accelerations, efforts and reactions are not determined: 0 is "
                         "shown") +
           ". The list goes on beyond it, but on which of these motions is not determined: choose "
           "postures beside it, between which it is",
       {}});
}

/// At a singular posture Newton's method converges slowly, from beside it. @param free the
/// coordinates that close the loops. @param from the last position on the way. @param posture
/// foretold, replaced. @returns whether it is there, and singular.
bool PostureList::lands(const StartDesign& design, const std::vector<int>& free,
                        const VectorX<double>& from, Posture* posture) {
  set_given_start(loops_.system, loops_.tree, design.parameters, posture->number, &posture->theta,
                  &posture->rate);
  loops_.followers.follow(*design.equations, posture);
  const LoopSearch search{free, Posture::kSingularRank, LoopRows::kEnforced};
  return closure_.newton().solve(design, search, posture) != Closure::kApart &&
         (posture->theta - from).cwiseAbs().maxCoeff() < kLanding && is_singular(design, *posture);
}

/// Goes on to posture `to` from the last regular one. @returns whether `posture` is there;
/// `counted` then has the turns of loops. @param opens_at the last part of the way that was tried.
bool PostureList::walk_on(const StartDesign& design, double to, Posture* posture, double* opens_at,
                          State<double>* counted) {
  const double from = regular_->number, way = to - from;
  PostureWay line{regular_->theta, {}, {}};
  posture->theta = line.last;
  *counted = regular_->state;
  VectorX<double> counted_at = posture->theta;
  posture->number = posture->time = from;
  set_given_start(loops_.system, loops_.tree, design.parameters, posture->number, &posture->theta,
                  &posture->rate);
  posture->dependent =
      closure_.dependent(design, *posture, LoopRows::kEnforced, posture->rank_tolerance);
  const std::vector<int> free = posture->dependent;
  posture->rate.setZero();
  TurnFollower<double> turns(loops_.system);
  double reached = 0.0;
  const auto arrive = [&] {
    reached = posture->number - from;
    count_turns(loops_, design, counted_at, *posture, &turns, counted);
    counted_at = posture->theta;
  };
  const auto place_at = [&](double part) -> const std::vector<double>& {
    posture->time = posture->number = from + way * part;
    *opens_at = part;
    return design.parameters;
  };
  const bool arrived = PostureWalk(loops_, design, free, place_at, &closure_.newton())
                           .go(way > 1.0 ? kGolden / way : 1.0, arrive, posture, &line);
  if (arrived || design.cancelled()) return arrived;
  posture->theta = line.last + (1.0 - reached / way) * line.slope;
  posture->time = posture->number = to;
  if (!lands(design, free, line.last, posture)) return false;
  arrive();
  return true;
}

/// Finds posture `at` as the first one is found, from the study's guesses, if the one before is
/// singular: if it is known to be, or if the loops determine more here.
bool PostureList::restart(const StartDesign& design, double at, Posture* posture,
                          State<double>* counted, Warnings* warnings) {
  const LoopMiss miss = posture->miss;
  posture->time = posture->number = at;
  first_.set(design.parameters, posture);
  loops_.followers.follow(*design.equations, posture);
  bool closes = positions_.find(design, &first_, posture, warnings).ok();
  if (closes && !is_singular_) {
    const std::size_t found = rank(design, *posture);
    closes = found > usual_rank_;
    usual_rank_ = std::max(usual_rank_, found);
    if (closes) warn_of_singular(design.parameters, at - 1.0, true, warnings);
  }
  if (!closes) {
    posture->miss = miss;
    return false;
  }
  std::vector<LinkMotion<double>> links;
  place(loops_, design, *posture, &links, counted);
  return true;
}

Status PostureList::go_on(const StartDesign& design, Posture* posture, State<double>* state,
                          Warnings* warnings) {
  const double before = posture->number, to = before + 1.0;
  double opens_at = 0.0;
  bool reached = regular_ && walk_on(design, to, posture, &opens_at, state);
  if (!reached && !design.cancelled()) reached = restart(design, to, posture, state, warnings);
  posture->time = posture->number = to;
  if (design.cancelled()) return {StatusCode::kCancelled, to, "cancelled"};
  if (reached) return {};
  return {StatusCode::kAssemblyFailed, to,
          "loop or coupling '" + std::string(posture->miss.owner) +
              "' cannot be closed on the way from posture " +
              readable(regular_ ? regular_->number : before) + ": it opens at " +
              readable(100.0 * opens_at, 2) + " % of the way"};
}

}  // namespace codesign
