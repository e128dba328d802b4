// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "python/jobs.h"

namespace codesign::python {

/// Recordings that Python gives, each as (name, time, [(joint, position, velocity, effort)],
/// [(signal, values)], set, mask, start, rest). @throws InputError for columns of another length
/// than the times and masks that are not above zero; as to_numbers()
RecordingArrays arrays_of(const pybind11::list& data, const pybind11::list& holdout);

}  // namespace codesign::python
