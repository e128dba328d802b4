// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_fields.h"

#include <cmath>
#include <limits>

namespace codesign {

void read_whole(const YamlValue& parent, const std::string& key, int least, int most, int* count) {
  const auto value = parent.find(key);
  if (!value) return;
  const std::string allowed = "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
  const double number = value->number();
  if (number != std::floor(number)) value->fail("not an integer", allowed);
  if (number < least || number > most) value->fail(key + " out of range", allowed);
  *count = static_cast<int>(number);
}

void read_sampler(const YamlValue& parent, SamplerKind* sampler, std::uint32_t* seed) {
  read_choice(parent, "sampler", kSamplerNames, sampler);
  int number = static_cast<int>(*seed);
  read_whole(parent, "seed", 0, std::numeric_limits<int>::max(), &number);
  *seed = static_cast<std::uint32_t>(number);
}

}  // namespace codesign
