// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "forces/law.h"

namespace codesign {

/// A transfer function in sigma = s / rate with the gain 1 at rest, theory (49):
///   first order   (lead sigma + 1) / (sigma + 1)
///   second order  (lead sigma^2 + middle sigma + 1) / (sigma^2 + damping sigma + 1).
template <class T>
struct FilterShape {
  T rate{0.0};  ///< [rad/s]
  T lead{0.0}, middle{0.0}, damping{0.0};
};

/// A number of a filter as files name it.
struct FilterNumber {
  const char* name = nullptr;                                  ///< null: none
  double standard = std::numeric_limits<double>::quiet_NaN();  ///< the default; NaN: required
  bool may_be_zero = false;
};

constexpr std::size_t kFilterNumbers = 3;
template <class T>
using FilterNumbers = std::array<T, kFilterNumbers>;
template <class T>
using FilterFunction = FilterShape<T> (*)(const FilterNumbers<T>& numbers);

/// A filter, one row of the table in filter_law.cc.
struct FilterLaw {
  const char* name = "";  ///< the value of the filter's `type`
  Law<FilterFunction> shape{};
  std::array<FilterNumber, kFilterNumbers> numbers{};
  int order = 1;
  /// whether the output jumps with the input: lead is not zero
  bool passes_steps = false;
  /// whether the sampled filter is exact at its frequency, and not at low ones
  bool is_prewarped = false;

  /// How many numbers it has.
  std::size_t count() const;
};

/// The law of a filter.
class FilterKind : public RowReference<FilterLaw> {
 public:
  using RowReference::RowReference;
  static const FilterKind kLowPass,  ///< of first order: frequency [Hz]
      kLowPass2,                     ///< of second order: frequency [Hz], damping
      kNotch,                        ///< frequency [Hz], damping, depth: the gain at its frequency
      kLeadLag;                      ///< of first order: the frequencies zero and pole [Hz]
};

/// The library's filters, by name.
std::vector<FilterKind> filter_laws();

}  // namespace codesign
