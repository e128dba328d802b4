// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/contact_law.h"

#include <iterator>
#include <string_view>

#include "codegen/traced.h"

namespace codesign {
namespace {

/// 1 + lambda delta': Hunt and Crossley, Coefficient of restitution interpreted as damping in
/// vibroimpact, J. Appl. Mech. 42 (1975) 440-445.
template <class T>
T hysteresis(const ContactValues<T>& x) {
  return 1.0 + x.loss * x.rate;
}

/// k delta + c delta'.
template <class T>
T linear(const ContactValues<T>& x) {
  return x.elastic + x.loss * x.rate;
}

/// Hunt and Crossley (1975), for e near 1.
template <class T>
T hunt_crossley_loss(const T& e) {
  return 1.5 * (1.0 - e);
}

/// Lankarani and Nikravesh, A contact force model with hysteresis damping for impact analysis of
/// multibody systems, J. Mech. Des. 112 (1990) 369-376: for e near 1.
template <class T>
T lankarani_nikravesh_loss(const T& e) {
  return 0.75 * (1.0 - e * e);
}

/// Flores, Machado, Silva and Martins, On the continuous contact force models for soft materials in
/// multibody dynamics, Multibody Syst. Dyn. 25 (2011) 357-375: for all e > 0.
template <class T>
T flores_loss(const T& e) {
  return 8.0 * (1.0 - e) / (5.0 * e);
}

/// lambda v_0 of gonthier_loss() for e near 1: of the powers of d in ln(1 + d) - ln(1 - e d) = d (1
/// + e), divided by d^2, those up to the sixth.
template <class T>
T gonthier_loss_near_one(const T& e) {
  constexpr int kSteps = 8, kPowers = 8;
  T d = 1.5 * (1.0 - e);
  for (int step = 0; step < kSteps; ++step) {
    T f(0.0), slope(0.0), power(1.0), of_e = e * e;
    double sign = 1.0;
    for (int k = 2; k <= kPowers; ++k, sign = -sign) {
      f += (of_e - sign) / k * power;
      of_e *= e;
      if (k < kPowers) slope += (of_e + sign) * (k - 1.0) / (k + 1.0) * power;
      power *= d;
    }
    d -= f / slope;
  }
  return d;
}

/// Gonthier, McPhee, Lange and Piedboeuf, A regularized contact model with asymmetric damping and
/// dwell-time dependent friction, Multibody Syst. Dyn. 11 (2004) 209-233: d = lambda v_0 of
/// (1 + d)/(1 - e d) = exp(d (1 + e)), which holds exactly, by Newton's method from 1/e.
template <class T>
T gonthier_loss(const T& e) {
  using std::exp;
  constexpr int kSteps = 30;
  const T near_one(0.99);  // above it the root at d = 0 is too near
  if (is_less(near_one, e, false)) return gonthier_loss_near_one(e);
  T d = 1.0 / e;
  for (int k = 0; k < kSteps; ++k) {
    const T grown = exp(d * (1.0 + e)), rest = 1.0 - e * d;
    d -= (rest * grown - (1.0 + d)) / (grown * (rest * (1.0 + e) - e) - 1.0);
  }
  return d;
}

constexpr ContactLaw make_row(const char* name, const char* title, Law<ContactLoss> restitution) {
  ContactLaw law;
  law.name = name;
  law.title = title;
  law.growth = {hysteresis, hysteresis};
  law.restitution = restitution;
  return law;
}

constexpr ContactLaw linear_law() {
  ContactLaw law = make_row("linear", "linear", {});
  law.loss_attribute = "damping";
  law.growth = {linear, linear};
  law.is_factor = false;
  law.exponent = 1.0;
  law.has_exponent = false;
  return law;
}

constexpr ContactLaw kContactTable[] = {
    make_row("hunt_crossley", "Hunt and Crossley", {hunt_crossley_loss, hunt_crossley_loss}),
    make_row("lankarani_nikravesh", "Lankarani and Nikravesh",
             {lankarani_nikravesh_loss, lankarani_nikravesh_loss}),
    make_row("flores", "Flores", {flores_loss, flores_loss}),
    make_row("gonthier", "Gonthier", {gonthier_loss, gonthier_loss}),
    linear_law(),
};

}  // namespace

static_assert(std::string_view(kContactTable[0].name) == "hunt_crossley",
              "the constant below counts rows: append new ones");
const ContactModel ContactModel::kHuntCrossley{kContactTable[0]};

std::vector<ContactModel> contact_laws() {
  return std::vector<ContactModel>(std::begin(kContactTable), std::end(kContactTable));
}

}  // namespace codesign
