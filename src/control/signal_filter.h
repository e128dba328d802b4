// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "description/control_realization.h"

namespace codesign {

/// A filter with its states x1, x2 in observable form, theory (49). With the input u and the output
///   y = direct u + x1
/// x1 and x2 go to
///   in1 u - back1 y + x2  and  in2 u - back2 y,
/// which are their rates in a continuous controller and their next values in a sampled one.
template <class T>
struct FilterSection {
  T direct{0.0}, in1{0.0}, back1{0.0}, in2{0.0}, back2{0.0};

  T output(const T& u, const T& x1) const { return direct * u + x1; }
  T first(const T& u, const T& y, const T& x2) const { return in1 * u - back1 * y + x2; }
  T second(const T& u, const T& y) const { return in2 * u - back2 * y; }
};

/// The section of a continuous filter.
template <class T>
FilterSection<T> continuous_section(const FilterShape<T>& h, int order) {
  if (order == 1) return {h.lead, h.rate, h.rate, T(0.0), T(0.0)};
  const T square = h.rate * h.rate;
  return {h.lead, h.rate * h.middle, h.rate * h.damping, square, square};
}

/// The same by the bilinear transform sigma = g (z - 1) / (z + 1).
/// @param g 2 / (rate T) with the sample time T, or 1 / tan(rate T / 2), with which the frequency
/// of the filter keeps its response.
template <class T>
FilterSection<T> sampled_section(const FilterShape<T>& h, int order, const T& g) {
  if (order == 1) {
    const T per = T(1.0) / (g + T(1.0));
    return {(h.lead * g + T(1.0)) * per, (T(1.0) - h.lead * g) * per, (T(1.0) - g) * per, T(0.0),
            T(0.0)};
  }
  const T square = g * g, per = T(1.0) / (square + h.damping * g + T(1.0));
  return {(h.lead * square + h.middle * g + T(1.0)) * per,
          T(2.0) * (T(1.0) - h.lead * square) * per, T(2.0) * (T(1.0) - square) * per,
          (h.lead * square - h.middle * g + T(1.0)) * per, (square - h.damping * g + T(1.0)) * per};
}

/// The section of a filter at one design. @param sample_time [s]; 0: the controller is continuous.
template <class T>
FilterSection<T> section_of(const FilterDescription& filter, double sample_time,
                            const std::vector<T>& parameters) {
  using std::cos;
  using std::sin;
  FilterNumbers<T> numbers{};
  for (std::size_t k = 0; k < filter.numbers.size(); ++k)
    numbers[k] = filter.numbers[k].at(parameters);
  const FilterShape<T> shape = filter.kind->shape.template of<T>(numbers);
  if (!(sample_time > 0.0)) return continuous_section(shape, filter.kind->order);
  const T half = T(0.5 * sample_time) * shape.rate;
  const T g = filter.kind->is_prewarped ? T(cos(half) / sin(half)) : T(T(1.0) / half);
  return sampled_section(shape, filter.kind->order, g);
}

/// The states of a filter that is at rest with the constant input u, whose output is u.
template <class T>
struct FilterRest {
  T x1, x2;
};
template <class T>
FilterRest<T> rest_of(const FilterSection<T>& section, bool is_sampled, const T& u) {
  const T x1 = u - section.direct * u;
  return {x1, (is_sampled ? x1 : T(0.0)) - section.in1 * u + section.back1 * u};
}

}  // namespace codesign
