// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/filter_law.h"

#include <iterator>
#include <string_view>

#include "codegen/traced.h"

namespace codesign {
namespace {

constexpr double kTurn = 6.283185307179586;  // [rad]
constexpr double kButterworth = 0.7071067811865476;

template <class T>
FilterShape<T> low_pass(const FilterNumbers<T>& x) {
  FilterShape<T> h;
  h.rate = kTurn * x[0];
  return h;
}

template <class T>
FilterShape<T> low_pass_2(const FilterNumbers<T>& x) {
  FilterShape<T> h = low_pass(x);
  h.damping = 2.0 * x[1];
  return h;
}

template <class T>
FilterShape<T> notch(const FilterNumbers<T>& x) {
  FilterShape<T> h = low_pass_2(x);
  h.lead = 1.0;
  h.middle = h.damping * x[2];
  return h;
}

template <class T>
FilterShape<T> lead_lag(const FilterNumbers<T>& x) {
  FilterShape<T> h;
  h.rate = kTurn * x[1];
  h.lead = x[1] / x[0];
  return h;
}

constexpr FilterNumber kFrequency{"frequency"};

constexpr FilterLaw make_row(const char* name, Law<FilterFunction> shape, int order,
                             std::array<FilterNumber, kFilterNumbers> numbers) {
  FilterLaw law;
  law.name = name;
  law.shape = shape;
  law.order = order;
  law.numbers = numbers;
  return law;
}

constexpr FilterLaw lead_lag_law() {
  FilterLaw law = make_row("lead_lag", {lead_lag, lead_lag}, 1, {FilterNumber{"zero"}, {"pole"}});
  law.passes_steps = true;
  return law;
}

constexpr FilterLaw low_pass_2_law() {
  FilterLaw law =
      make_row("low_pass_2", {low_pass_2, low_pass_2}, 2, {kFrequency, {"damping", kButterworth}});
  law.is_prewarped = true;
  return law;
}

constexpr FilterLaw notch_law() {
  FilterLaw law =
      make_row("notch", {notch, notch}, 2, {kFrequency, {"damping"}, {"depth", 0.0, true}});
  law.passes_steps = law.is_prewarped = true;
  return law;
}

constexpr FilterLaw kFilterTable[] = {
    lead_lag_law(),
    make_row("low_pass", {low_pass, low_pass}, 1, {kFrequency}),
    low_pass_2_law(),
    notch_law(),
};

}  // namespace

static_assert(std::string_view(kFilterTable[0].name) == "lead_lag" &&
                  std::string_view(kFilterTable[3].name) == "notch",
              "the constants below count rows: append new ones");
const FilterKind FilterKind::kLeadLag{kFilterTable[0]}, FilterKind::kLowPass{kFilterTable[1]},
    FilterKind::kLowPass2{kFilterTable[2]}, FilterKind::kNotch{kFilterTable[3]};

std::size_t FilterLaw::count() const {
  std::size_t count = 0;
  while (count < numbers.size() && numbers[count].name) ++count;
  return count;
}

std::vector<FilterKind> filter_laws() {
  return std::vector<FilterKind>(std::begin(kFilterTable), std::end(kFilterTable));
}

}  // namespace codesign
