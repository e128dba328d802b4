// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "benchmark/peer_cases.h"

namespace codesign {

/// What a run gives: the steps that it took, or evaluations, and its values.
struct PeerAnswer {
  long steps = 0;
  std::vector<double> values;
};
using PeerRun = std::function<PeerAnswer()>;

/// Where fits begin: each parameter is 1 in truth.
constexpr double kPeerStart = 1.3;

/// Fits the parameters of a case to its recording, in motion, in one segment whose start is fitted,
/// too. @param solver entries of the study's block `solver`.
PeerRun identification(const PeerCase& of, const std::string& solver);

}  // namespace codesign
