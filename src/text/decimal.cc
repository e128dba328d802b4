// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "text/decimal.h"

#include <array>
#include <charconv>

namespace codesign {

std::string to_decimal(double value) {
  std::array<char, 32> text;  // a double needs at most 24
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return std::string(text.data(), result.ptr);
}

}  // namespace codesign
