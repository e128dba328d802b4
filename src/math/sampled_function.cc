// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/sampled_function.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

#include "math/arrays.h"

namespace codesign {

SampledFunction::SampledFunction(std::vector<double> times, std::vector<double> values)
    : times_(std::move(times)), values_(std::move(values)), slopes_(times_.size(), 0.0) {
  if (times_.empty() || times_.size() != values_.size())
    throw std::invalid_argument("a sampled function needs one value per time");
  if (std::adjacent_find(times_.begin(), times_.end(), std::greater_equal<>()) != times_.end())
    throw std::invalid_argument("the times of a sampled function must ascend");
  const std::size_t last = times_.size() - 1;
  if (last == 0) return;
  const auto chord = [this](std::size_t k) {
    return (values_[k + 1] - values_[k]) / (times_[k + 1] - times_[k]);
  };
  for (std::size_t k = 1; k < last; ++k) {
    const double before = times_[k] - times_[k - 1], after = times_[k + 1] - times_[k];
    slopes_[k] = (after * chord(k - 1) + before * chord(k)) / (before + after);
  }
  slopes_[0] = last > 1 ? 2.0 * chord(0) - slopes_[1] : chord(0);
  slopes_[last] = last > 1 ? 2.0 * chord(last - 1) - slopes_[last - 1] : chord(0);
}

SampledFunction::Sample SampledFunction::at(double time) const {
  if (time < times_.front()) return {values_.front()};
  if (time > times_.back() || times_.size() == 1) return {values_.back()};
  const auto above = std::upper_bound(times_.begin() + 1, times_.end() - 1, time);
  const auto k = to_index(above - times_.begin()) - 1;
  const double h = times_[k + 1] - times_[k], s = (time - times_[k]) / h,
               rise = values_[k + 1] - values_[k];
  // v0 + s rise + s (1 - s) c with c = a (1 - s) + b s
  const double a = h * slopes_[k] - rise, b = rise - h * slopes_[k + 1], c = a * (1.0 - s) + b * s,
               turn = b - a;
  Sample sample;
  sample.value = values_[k] + s * rise + s * (1.0 - s) * c;
  sample.slope = (rise + (1.0 - 2.0 * s) * c + s * (1.0 - s) * turn) / h;
  sample.second = (2.0 * (1.0 - 2.0 * s) * turn - 2.0 * c) / (h * h);
  sample.third = -6.0 * turn / (h * h * h);
  return sample;
}

}  // namespace codesign
