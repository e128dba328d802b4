// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "fuzz/dice.h"

namespace codesign::fuzz {

/// A place of a number of four bytes that is small, as lengths and counts are; any place if there
/// is none.
inline std::size_t place_of_length(const std::string& bytes, Dice* dice) {
  std::size_t place = 0;
  for (int tries = 0; tries < 200; ++tries) {
    place = dice->below(bytes.size() - 4);
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.data() + place, sizeof number);
    if (number > 0 && number < 1000) break;
  }
  return place;
}

/// A binary file with one fault: changed bytes, a cut, a changed length, two lengths exchanged,
/// bytes that are missing or too many.
inline std::string damage(std::string bytes, Dice* dice) {
  static const std::vector<std::uint32_t> kLengths = {0,          1,          5,         0x7fffffff,
                                                      0x80000000, 0xffffffff, 0x10000000};
  if (bytes.size() < 8) return bytes;
  const std::size_t at = dice->below(bytes.size());
  switch (dice->below(6)) {
    case 0:
      for (std::size_t left = 1 + dice->below(20); left > 0; --left)
        bytes[dice->below(bytes.size())] = static_cast<char>(dice->below(256));
      break;
    case 1:
      bytes.resize(at);
      break;
    case 2: {
      const std::uint32_t number =
          dice->one_in(2) ? dice->pick(kLengths) : static_cast<std::uint32_t>(dice->below(5000));
      std::memcpy(bytes.data() + place_of_length(bytes, dice), &number, sizeof number);
      break;
    }
    case 3: {
      const auto one = bytes.begin() + static_cast<std::ptrdiff_t>(place_of_length(bytes, dice));
      std::swap_ranges(one, one + 4,
                       bytes.begin() + static_cast<std::ptrdiff_t>(place_of_length(bytes, dice)));
      break;
    }
    case 4:
      bytes.erase(at, 1 + dice->below(200));
      break;
    default:
      bytes.insert(at, 1 + dice->below(200), static_cast<char>(dice->below(256)));
  }
  return bytes;
}

}  // namespace codesign::fuzz
