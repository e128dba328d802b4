// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/ApplyRequest.h>
#include <mechanism_codesign/ApplyResponse.h>

#include <atomic>
#include <string>

namespace codesign {

/// Sends the gains of a finished optimization to the servers of a running robot, as doc/results.md describes, for the service `apply` and
/// for `codesign apply`. It serves its callbacks in a thread of its own, and does not throw.
/// @param request all but `result`. @param path of the job's folder or bag. @param cancel once set, the values that were sent are rolled
/// back.
mechanism_codesign::ApplyResponse apply_gains(const mechanism_codesign::ApplyRequest& request, const std::string& path,
                                              const std::atomic<bool>& cancel);

}  // namespace codesign
