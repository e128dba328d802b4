// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <vector>

#include "text/cancel.h"

namespace codesign {

template <class T>
class Equations;

/// A design whose start is sought, and who may end the search.
struct StartDesign {
  const std::vector<double>& parameters;  ///< all named ones (Study::parameters order)
  /// must hold the design at `parameters`; positions that are given may differ from theirs, since
  /// the constants do not depend on these
  Equations<double>* equations;
  const std::atomic<bool>* cancel = nullptr;  ///< Assembly::obey()

  bool cancelled() const { return is_set(cancel); }
  /// The same search at another design, which `equations` must then hold.
  StartDesign at(const std::vector<double>& others) const { return {others, equations, cancel}; }
};

}  // namespace codesign
