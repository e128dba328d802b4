// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/signal.h"
#include "reading/study/study_values.h"

namespace codesign {

/// Reads a function of a signal s that is given by its values v_k at s = x_k, as the expression of
/// it: {type: table, signal: S, at: [x_0, ...], values: [v_0, ...]}, doc/theory.md (C2d).
/// Through the values runs the natural cubic spline, or a line from value to value; before the
/// first and after the last the function goes on along its tangent there; with `periodic: true` the
/// table is one period x_n - x_0 of it. Values are quantities.
/// @throws InputError for fewer than two values, values of `at` that do not ascend, a period whose
/// last value differs from its first, and a signal that is none.
SignalDescription read_signal_table(const YamlValue& value, const ParameterTable& table);

}  // namespace codesign
