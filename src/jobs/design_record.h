// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "jobs/json.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// The record of a run of one design: a table for people and plotting, and a summary for the report.
struct DesignRecord {
  Status status;
  std::string csv;  ///< `time` and shown_signals(), at 501 equally spaced instants
  /// `signals` (name, unit, smallest, largest, their times, limits), `energy` and `friction_energy` [J], `limits_exceeded`, `poses`.
  Json summary;
};

/// Runs the nominal study at `parameters`. Peaks are taken over 1001 samples; energies are integrals of powers over these samples by
/// Simpson's rule, negative if energy leaves the mechanism.
/// @param parameters all named parameters. @param cancel once set, the run ends soon with kCancelled; nullptr: no cancellation.
DesignRecord record_design(const Problem& problem, const std::vector<double>& parameters, const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign
