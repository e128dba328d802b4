// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/signal_filter.h"

#include <gtest/gtest.h>

#include <array>
#include <complex>

#include "codegen/traced.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
constexpr double kTurn = 6.283185307179586;

FilterDescription filter(const FilterKind& kind, const std::vector<double>& numbers) {
  FilterDescription description;
  description.kind = kind;
  for (const double number : numbers) description.numbers.emplace_back(number);
  return description;
}

/// The filters of the tests: lead-lag, low-passes, a notch of some depth.
std::vector<FilterDescription> all_filters() {
  return {filter(FilterKind::kLeadLag, {5.0, 50.0}), filter(FilterKind::kLowPass, {25.0}),
          filter(FilterKind::kLowPass2, {40.0, 0.3}), filter(FilterKind::kNotch, {60.0, 0.3, 0.1})};
}

/// The transfer function of a filter by its definition.
Complex defined(const FilterDescription& of, const Complex& s) {
  std::array<double, 3> x{};
  for (std::size_t k = 0; k < of.numbers.size(); ++k) x.at(k) = of.numbers[k].nominal();
  if (of.kind == FilterKind::kLeadLag)
    return (1.0 + s / (kTurn * x[0])) / (1.0 + s / (kTurn * x[1]));
  const double w = kTurn * x[0];
  if (of.kind == FilterKind::kLowPass) return w / (s + w);
  const Complex below = s * s + 2.0 * x[1] * w * s + w * w;
  if (of.kind == FilterKind::kLowPass2) return w * w / below;
  return (s * s + 2.0 * x[1] * x[2] * w * s + w * w) / below;
}

/// That of a section, with s or z for what its states go to.
Complex response(const FilterSection<double>& of, int order, const Complex& s) {
  // s x1 = in1 - back1 y + x2, s x2 = in2 - back2 y, y = direct + x1, for the input 1.
  const Complex in = order == 2 ? of.in1 + of.in2 / s : of.in1;
  const Complex back = order == 2 ? of.back1 + of.back2 / s : of.back1;
  return (of.direct + in / s) / (1.0 + back / s);
}

TEST(FilterSection, HasTheTransferFunctionOfItsFilter) {
  for (const FilterDescription& one : all_filters()) {
    const FilterSection<double> section = section_of(one, 0.0, std::vector<double>{});
    for (const double frequency : {0.3, 7.0, 40.0, 60.0, 300.0}) {
      const Complex s(0.0, kTurn * frequency), expected = defined(one, s);
      EXPECT_LT(std::abs(response(section, one.kind->order, s) - expected),
                1e-12 * (1.0 + std::abs(expected)))
          << one.kind->name << " " << frequency;
    }
  }
}

// The bilinear transform has the response of the filter at another frequency, 2/T tan(w T/2), or
// with a factor that makes it exact at the filter's own frequency.
TEST(FilterSection, SampledIsTheBilinearTransform) {
  constexpr double kTime = 0.002;
  for (const FilterDescription& one : all_filters()) {
    const FilterSection<double> section = section_of(one, kTime, std::vector<double>{});
    const double own = kTurn * one.numbers[0].nominal();
    const double scale = one.kind->is_prewarped ? own / std::tan(0.5 * own * kTime) : 2.0 / kTime;
    for (const double frequency : {0.3, 7.0, 40.0, 60.0, 240.0}) {
      const double w = kTurn * frequency;
      const Complex expected = defined(one, Complex(0.0, scale * std::tan(0.5 * w * kTime)));
      const Complex z = std::polar(1.0, w * kTime);
      EXPECT_LT(std::abs(response(section, one.kind->order, z) - expected),
                1e-10 * (1.0 + std::abs(expected)))
          << one.kind->name << " " << frequency;
    }
  }
}

/// The outputs of a sampled filter that has been at rest with the input 0.
std::vector<double> outputs(const FilterDescription& one) {
  const FilterSection<double> section = section_of(one, 0.002, std::vector<double>{});
  double x1 = 0.0, x2 = 0.0;
  std::vector<double> y;
  for (const double u : {1.0, 1.0, -0.5, 2.0, 0.0, 0.0, 1.0, 3.0}) {
    y.push_back(section.output(u, x1));
    x1 = section.first(u, y.back(), x2);
    x2 = one.kind->order == 2 ? section.second(u, y.back()) : 0.0;
  }
  return y;
}

void expect_outputs(const FilterDescription& one, const std::vector<double>& expected) {
  const std::vector<double> y = outputs(one);
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(y[k], expected[k], 1e-12) << one.kind->name << " " << k;
}

// References: scipy.signal 1.10, bilinear() with fs = w/(2 tan(w T/2)) of the notch, butter(2, 40,
// fs=500), bilinear() of the others; lfilter().
TEST(FilterSection, FiltersAsScipyDoes) {
  expect_outputs(
      filter(FilterKind::kNotch, {60.0, 0.3, 0.0}),
      {0.8296248192854584, 0.623549064486134, -0.5874502678557163, 1.9720252840136643,
       -0.06137259691521635, 0.28496001478597555, 1.2147554833668295, 2.5607702185146666});
  expect_outputs(filter(FilterKind::kLowPass2, {40.0, std::sqrt(0.5)}),
                 {0.046131802093312906, 0.19870282051036658, 0.3524025428819975, 0.4552296939270537,
                  0.5832603878673726, 0.6308636429460792, 0.583995801521708, 0.6838415190870594});
  expect_outputs(filter(FilterKind::kLowPass, {25.0}),
                 {0.1357552481636332, 0.3704067696829604, 0.337715067885177, 0.449654754431926,
                  0.5990792652074651, 0.4364229565716123, 0.4536847911878741, 0.8735256010108551});
  expect_outputs(filter(FilterKind::kLeadLag, {5.0, 50.0}),
                 {7.848484987503805, 4.574125373399527, -8.907443085058992, 14.733489386858686,
                  -7.05154582754613, -3.680099892152708, 5.927894021007136, 19.26876667019539});
}

TEST(FilterSection, RestsWithAConstantInput) {
  for (const double time : {0.0, 0.002})
    for (const FilterDescription& one : all_filters()) {
      const FilterSection<double> section = section_of(one, time, std::vector<double>{});
      const auto [x1, x2] = rest_of(section, time > 0.0, -1.7);
      const double y = section.output(-1.7, x1), of_second = one.kind->order == 2 ? x2 : 0.0;
      EXPECT_NEAR(y, -1.7, 1e-14);
      EXPECT_NEAR(section.first(-1.7, y, of_second), time > 0.0 ? x1 : 0.0, 1e-10)
          << one.kind->name;
      EXPECT_NEAR(section.second(-1.7, y), time > 0.0 && one.kind->order == 2 ? x2 : 0.0, 1e-10)
          << one.kind->name;
    }
}

}  // namespace
}  // namespace codesign
