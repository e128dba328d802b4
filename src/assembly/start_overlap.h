// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mechanism_codesign/warning.h"
#include "system/state.h"

namespace codesign {

class CompiledSystem;
template <class T>
class Equations;

/// A warning `start_overlaps` for each contact whose shapes overlap at the start by more than 5 %
/// of the smaller one: the contact then holds energy, (13l), which throws them apart. Of a study of
/// postures there is none. @param state the assembled start. @param equations must hold the design.
/// @throws InputError for shapes that overlap by more than the smaller one, so that the contact
/// would push them to the wrong side.
Warnings find_overlaps(const CompiledSystem& system, const State<double>& state,
                       Equations<double>* equations);

}  // namespace codesign
