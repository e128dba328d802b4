// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "equations/equation_recorder.h"
#include "equations/equation_variant.h"

namespace codesign {

/// The variants of one part of the equations of a system that states have needed so far. The first
/// one has the expected outcome of every decision; the others are added when a state decides
/// otherwise. A variant depends on its outcomes alone, so results do not depend on the order in
/// which variants were added. Thread-safe.
class EquationVariants {
 public:
  /// @param begun the residual with expected outcomes, for the first variant; may be null.
  explicit EquationVariants(std::unique_ptr<ResidualRecording> begun = nullptr)
      : begun_(std::move(begun)) {}

  /// The k-th variant; null if fewer are known. The first one is recorded by the first call for it.
  const EquationVariant* at(std::size_t k, const CompiledSystem& system, EquationPart part);
  /// Adds a variant, unless one with the same outcomes is known. @return its index.
  std::size_t keep(std::unique_ptr<EquationVariant> variant);

 private:
  std::mutex mutex_;
  std::unique_ptr<ResidualRecording> begun_;  ///< until the first variant takes it
  std::deque<std::unique_ptr<EquationVariant>> variants_;
};

}  // namespace codesign
