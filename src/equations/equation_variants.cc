// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/equation_variants.h"

#include <algorithm>
#include <utility>

#include "math/arrays.h"

namespace codesign {

const EquationVariant* EquationVariants::at(std::size_t k, const CompiledSystem& system,
                                            EquationPart part) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (variants_.empty())
    variants_.push_back(std::make_unique<EquationVariant>(system, part, std::vector<bool>(),
                                                          std::vector<bool>(), std::move(begun_)));
  return k < variants_.size() ? variants_[k].get() : nullptr;
}

std::size_t EquationVariants::keep(std::unique_ptr<EquationVariant> variant) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = std::find_if(variants_.begin(), variants_.end(),
                                  [&](const std::unique_ptr<EquationVariant>& other) {
                                    return other->outcomes() == variant->outcomes();
                                  });
  const auto index = to_index(known - variants_.begin());
  if (known == variants_.end()) variants_.push_back(std::move(variant));
  return index;
}

}  // namespace codesign
