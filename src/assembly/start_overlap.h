// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mechanism_codesign/warning.h"
#include "system/state.h"

namespace codesign {

class CompiledSystem;
struct ContactDescription;
template <class T>
struct ContactConstants;
template <class T>
class Equations;

/// The part of the smaller shape by which shapes may overlap without a word.
constexpr double kDeepOverlap = 0.05;

/// The smaller extent of both shapes [m].
double smaller_extent(const ContactDescription& contact, const ContactConstants<double>& c);

/// A warning `start_overlaps` for each contact whose shapes overlap at the start by more than 5 %
/// of the smaller one: the contact then holds energy, (13l), which throws them apart. Of a study of
/// postures there is none. @param state the assembled start. @param equations must hold the design.
/// @throws InputError for shapes that overlap by more than the smaller one, so that the contact
/// would push them to the wrong side.
Warnings find_overlaps(const CompiledSystem& system, const State<double>& state,
                       Equations<double>* equations);

}  // namespace codesign
