// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mechanism_codesign/warning.h"
#include "system/state.h"

namespace codesign {

class CompiledSystem;
template <class T>
class Equations;

/// A warning `start_beyond_stop` for each joint that starts beyond an enforced stop by more than 2
/// % of its range: the stop's spring then holds energy, (13c), which throws the joint back. Of a
/// stop on one side only, and of a study of postures, there is none. @param state the assembled
/// start.
/// @param equations must hold the design.
Warnings starts_beyond_stops(const CompiledSystem& system, const State<double>& state,
                             Equations<double>* equations);

}  // namespace codesign
