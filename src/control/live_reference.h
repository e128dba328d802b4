// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "control/reference_motion.h"
#include "description/reference.h"

namespace codesign {

template <class T>
class Reference;

/// A function that commands set during a run, read at each call, and the planned function until the
/// first command.
template <class T>
class LiveReference {
 public:
  /// Unlike the other kinds it allocates the planned function at each call.
  void set(const LiveDescription& live, const std::vector<T>& parameters);
  ReferenceMotion<T> at(double t) const;

  /// What a function that is commanded prescribes at time t [s].
  static ReferenceMotion<T> commanded_at(const LiveFunction& function, double t);

 private:
  std::shared_ptr<const LiveFunction> function_;
  std::shared_ptr<const Reference<T>> planned_;  ///< in effect until a command sets function_
};

}  // namespace codesign
