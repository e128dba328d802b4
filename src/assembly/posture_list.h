// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "assembly/first_posture.h"
#include "assembly/loop_closure.h"
#include "assembly/posture.h"
#include "assembly/start_design.h"
#include "assembly/start_positions.h"
#include "math/scalar.h"
#include "mechanism_codesign/status.h"
#include "system/state.h"

namespace codesign {

struct TreeLoops;

/// The postures of a study's list so far, and the positions of the next one, doc/theory.md (21f).
/// Not thread-safe.
class PostureList {
 public:
  /// @param loops, first, closure, positions must outlive this.
  PostureList(const TreeLoops& loops, FirstPosture* first, LoopClosure* closure,
              StartPositions* positions)
      : loops_(loops), first_(*first), closure_(*closure), positions_(*positions) {}

  /// The list begins with a closed posture, whose turns are those of `state`.
  void begin(const StartDesign& design, const Posture& posture, const State<double>& state);

  /// Goes on to the next posture: along the straight line between the given positions from the last
  /// regular one, else from the study's guesses. Sets number and time of `posture` in any case; the
  /// rest is of use if it succeeds.
  /// @param state of the posture before; receives the turns of loops of the next one.
  /// @param warnings receives `singular_posture` if the one before turns out to be.
  /// @returns kAssemblyFailed, which says where the loops open on the way; kCancelled.
  Status go_on(const StartDesign& design, Posture* posture, State<double>* state,
               Warnings* warnings);

  /// Whether the loops determine fewer of the coordinates that are not given than in another
  /// posture so far. This one counts from now on.
  bool is_singular(const StartDesign& design, const Posture& posture);
  /// A posture of the list was found.
  void add(const Posture& posture, const State<double>& state, bool is_singular);
  /// @param number of a posture that is singular. @param has_forces whether its accelerations and
  /// reactions are determined.
  void warn_of_singular(const std::vector<double>& parameters, double number, bool has_forces,
                        Warnings* warnings) const;

 private:
  /// The last posture of the list that is not singular.
  struct Regular {
    VectorX<double> theta;
    double number = 0.0;
    State<double> state;
  };

  std::size_t rank(const StartDesign& design, const Posture& posture);
  std::string text(const std::vector<double>& parameters, double number) const;
  bool walk_on(const StartDesign& design, double to, Posture* posture, double* opens_at,
               State<double>* counted);
  bool lands(const StartDesign& design, const std::vector<int>& free, const VectorX<double>& from,
             Posture* posture);
  bool restart(const StartDesign& design, double at, Posture* posture, State<double>* counted,
               Warnings* warnings);

  const TreeLoops& loops_;
  FirstPosture& first_;
  LoopClosure& closure_;
  StartPositions& positions_;
  bool is_singular_ = false;        ///< the last one
  std::optional<Regular> regular_;  ///< none yet: empty
  std::size_t usual_rank_ = 0;      ///< most coordinates that the loops determine in any of them
};

}  // namespace codesign
