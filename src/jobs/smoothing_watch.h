// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/signal.h"
#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/warning.h"
#include "problem/load_problem.h"

namespace codesign {

/// Finds bearings and gears whose smoothing, epsilon of theory (12) and (9b), is more than 1 % of
/// the largest load that it smooths in a run: their friction is then that of loads which are not
/// there.
class SmoothingWatch {
 public:
  /// @param parameters all named parameters. @param names of the frames to observe.
  SmoothingWatch(const Problem& problem, const std::vector<double>& parameters,
                 const FrameNames& names);

  /// The signals that frames need beside those of the user: torques of gears.
  static std::vector<SignalDescription> signals(const Problem& problem);

  /// @param first index in Frame::signals of signals().
  void observe(const Frame& frame, std::size_t first);
  /// A warning `large_smoothing` for each bearing or gear.
  Warnings warnings() const;

 private:
  struct Watched {
    SourceLocation where;
    std::string element, load;  ///< load: what is smoothed, in words
    std::size_t sample = 0;     ///< index in Frame::frictions or behind `first`
    bool is_gear = false;
    bool is_given = false;  ///< by the model
    double smoothing = 0.0, preload = 0.0, largest = 0.0;
  };
  std::vector<Watched> watched_;
};

}  // namespace codesign
