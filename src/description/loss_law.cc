// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/loss_law.h"

#include <cmath>
#include <iterator>
#include <string_view>

#include "codegen/traced.h"

namespace codesign {
namespace {

template <class T>
T square_root(const LossValues<T>& x) {
  return x.residual();
}
double square_weight(double, double) { return 1.0; }

template <class T>
T absolute(const LossValues<T>& x) {
  return x.is_above(T(0.0), kAtReference, true) ? x.residual() : -x.residual();
}

template <class T>
T huber(const LossValues<T>& x) {
  const T r = x.residual(), &c = x.scale;
  if (x.is_above(c, kScaleAbove, false)) return c * (T(2.0) * r - c);
  if (!x.is_above(T(-c), kScaleBelow, true)) return c * (T(-2.0) * r - c);
  return r * r;
}
double huber_weight(double r, double c) { return std::abs(r) <= c ? 1.0 : c / std::abs(r); }

// Written without the difference of two numbers that are nearly equal for small r.
template <class T>
T soft_l1(const LossValues<T>& x) {
  using std::sqrt;
  const T r = x.residual(), &c = x.scale;
  return T(2.0) * r * r / (T(1.0) + sqrt(T(1.0) + r * r / (c * c)));
}
double soft_l1_weight(double r, double c) { return 1.0 / std::sqrt(1.0 + r * r / (c * c)); }

template <class T>
T above_root(const LossValues<T>& x) {
  return x.is_above(T(0.0), kAtReference, false) ? x.residual() : T(0.0);
}

template <class T>
T below_root(const LossValues<T>& x) {
  return x.is_above(T(0.0), kAtReference, true) ? T(0.0) : x.residual();
}

constexpr LossLaw make_square(const char* name, Law<LossFunction> root) {
  LossLaw law;
  law.name = name;
  law.root = root;
  return law;
}

constexpr LossLaw make_row(const char* name, Law<LossFunction> value) {
  LossLaw law;
  law.name = name;
  law.value = value;
  return law;
}

constexpr LossLaw square_law() {
  LossLaw law = make_square("square", {square_root, square_root});
  law.weight = square_weight;
  return law;
}

constexpr LossLaw huber_law() {
  LossLaw law = make_row("huber", {huber, huber});
  law.has_scale = true;
  law.weight = huber_weight;
  return law;
}

constexpr LossLaw soft_l1_law() {
  LossLaw law = make_row("soft_l1", {soft_l1, soft_l1});
  law.has_scale = true;
  law.weight = soft_l1_weight;
  return law;
}

constexpr LossLaw kLossTable[] = {square_law(),
                                  make_row("absolute", {absolute, absolute}),
                                  huber_law(),
                                  soft_l1_law(),
                                  make_square("above", {above_root, above_root}),
                                  make_square("below", {below_root, below_root})};

}  // namespace

static_assert(std::string_view(kLossTable[0].name) == "square" &&
                  std::string_view(kLossTable[5].name) == "below",
              "the constants below count rows: append new ones");
const LossKind LossKind::kSquare{kLossTable[0]}, LossKind::kAbsolute{kLossTable[1]},
    LossKind::kHuber{kLossTable[2]}, LossKind::kSoftL1{kLossTable[3]},
    LossKind::kAbove{kLossTable[4]}, LossKind::kBelow{kLossTable[5]};

std::vector<LossKind> losses() {
  return std::vector<LossKind>(std::begin(kLossTable), std::end(kLossTable));
}

}  // namespace codesign
