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

constexpr FilterLaw kFilterTable[] = {
    {"lead_lag", {lead_lag, lead_lag}, {FilterNumber{"zero"}, {"pole"}}, 1, true, false},
    {"low_pass", {low_pass, low_pass}, {kFrequency}, 1, false, false},
    {"low_pass_2",
     {low_pass_2, low_pass_2},
     {kFrequency, {"damping", kButterworth}},
     2,
     false,
     true},
    {"notch", {notch, notch}, {kFrequency, {"damping"}, {"depth", 0.0, true}}, 2, true, true},
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
