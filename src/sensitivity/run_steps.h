// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "mechanism_codesign/statistics.h"

namespace codesign {

class CompiledSystem;
struct Study;

/// The steps of a run that checks what other runs of a study have in common, doc/theory.md (22c):
/// smaller tolerances, a largest step, and a method that the study did not take.
struct RunSteps {
  enum class Method : std::uint8_t { kOwn, kDopri5, kRodas5P, kRodas4P2 };
  Method method = Method::kOwn;  ///< kOwn: the steps that the study chooses
  /// ten times the tolerances, and shorter longest steps: what the steps themselves cost shows
  /// between both sets
  bool is_second = false;
  std::int32_t most = 0;  ///< steps, after which the run fails
};

inline bool operator<(const RunSteps& a, const RunSteps& b) {
  if (a.method != b.method) return a.method < b.method;
  return a.is_second != b.is_second ? b.is_second : a.most < b.most;
}

/// As in a study: "rodas5p".
const char* name_of(RunSteps::Method method);

/// The method that a run did not take: an implicit one beside the explicit pair and `idas`, and the
/// pair beside an implicit one. @param own of runs of the study.
RunSteps::Method other_method(const CompiledSystem& system, const Statistics& own);
/// The implicit method where other_method() fails, as the explicit pair in stiff motions.
RunSteps::Method fallback_method(const CompiledSystem& system, RunSteps::Method failed);

/// The study with these steps. A pulse of an expression of the time, between two break times that
/// are near to each other, is divided like the study.
Study with_steps(const Study& study, const RunSteps& steps);
std::shared_ptr<const CompiledSystem> with_steps(const CompiledSystem& system,
                                                 const RunSteps& steps);

}  // namespace codesign
