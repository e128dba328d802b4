// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/contact_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace codesign {
namespace {

const ContactLaw& law_of(const std::string& name) {
  static const std::vector<ContactModel> laws = contact_laws();
  for (const ContactModel& law : laws)
    if (law->name == name) return *law;
  throw std::out_of_range(name);
}

ContactNumbers<double> numbers(double stiffness, double exponent, double loss) {
  return {stiffness, exponent, loss, 1e-13};
}

ContactForce<double> force(const std::string& law, double gap, double rate,
                           const ContactNumbers<double>& c, bool has_loss = true) {
  return contact_force(law_of(law), has_loss, gap, rate, c, 0);
}

TEST(ContactLaw, ByHand) {
  const ContactNumbers<double> c = numbers(1e6, 1.5, 0.5);
  // delta = 1e-4: k delta^1.5 = 1 N; growing at 2 m/s: 1 + 0.5 2 = 2.
  EXPECT_NEAR(force("hunt_crossley", -1e-4, -2.0, c).normal, 2.0, 1e-8);
  EXPECT_NEAR(force("hunt_crossley", -1e-4, 1.0, c).normal, 0.5, 1e-8);
  EXPECT_NEAR(force("hunt_crossley", -1e-4, 1.0, c).elastic, 1.0, 1e-8);
  EXPECT_NEAR(force("hunt_crossley", -1e-4, 1.0, c, false).normal, 1.0, 1e-8) << "no loss";
  EXPECT_NEAR(force("linear", -1e-4, -2.0, numbers(1e4, 1.0, 0.25)).normal, 1.5, 1e-14);
  EXPECT_NEAR(force("hunt_crossley", -1e-2, 0.0, numbers(100.0, 1.0, 0.0)).normal, 1.0, 1e-10)
      << "n = 1";
  EXPECT_NEAR(force("hunt_crossley", -1e-2, 0.0, numbers(1e4, 2.0, 0.0)).normal, 1.0, 1e-14)
      << "n = 2";
}

TEST(ContactLaw, NeitherPullsNorActsFromAfar) {
  for (const ContactModel& law : contact_laws()) {
    const ContactNumbers<double> c = numbers(1e6, 1.5, 0.5);
    for (double gap : {0.0, 1e-12, 1.0}) {
      const ContactForce<double> none = contact_force(*law, true, gap, -3.0, c, 0);
      EXPECT_FALSE(none.touches) << law->name;
      EXPECT_EQ(none.normal, 0.0) << law->name;
    }
    for (double rate : {2.0, 1e3}) {  // 1 - 0.5 2 = 0; linear: 1e-9 1e6 - 0.5 2 < 0
      const ContactForce<double> parting = contact_force(*law, true, -1e-9, rate, c, 0);
      EXPECT_TRUE(parting.touches) << law->name;
      EXPECT_EQ(parting.normal, 0.0) << law->name;
      EXPECT_GT(parting.elastic, 0.0) << law->name;
    }
    EXPECT_GT(contact_force(*law, true, -1e-9, -1.0, c, 0).normal, 0.0) << law->name;
  }
}

TEST(ContactLaw, OnlyLinearJumpsAtTheTouch) {
  const ContactNumbers<double> c = numbers(1e6, 1.5, 0.5);
  for (const ContactModel& law : contact_laws()) {
    const double at_once = contact_force(*law, true, -1e-15, -1.0, c, 0).normal;
    if (law->is_factor)
      EXPECT_LT(at_once, 1e-9) << law->name;
    else
      EXPECT_NEAR(at_once, 0.5, 1e-8) << law->name;
  }
}

TEST(ContactLaw, EnergyIsTheIntegralOfTheElasticForce) {
  for (const ContactModel& law : contact_laws())
    for (double exponent : {1.0, 1.2, 1.5, 2.0, 3.0}) {
      const ContactNumbers<double> c = numbers(1e3, exponent, 0.3);
      constexpr int kParts = 4000;
      constexpr double kDepth = 2e-3;
      double sum = 0.0;  // midpoints in s with depth = kDepth s^3, so that the start is fine
      for (int k = 0; k < kParts; ++k) {
        const double s = (k + 0.5) / kParts;
        sum += contact_force(*law, true, -kDepth * s * s * s, 0.0, c, 0).elastic * 3.0 * kDepth *
               s * s / kParts;
      }
      EXPECT_NEAR(contact_energy(*law, -kDepth, c) / sum, 1.0, 1e-6) << law->name << exponent;
    }
  EXPECT_EQ(contact_energy(law_of("flores"), 1e-3, numbers(1e3, 1.5, 0.3)), 0.0);
}

/// The speed with which a mass leaves that arrives with 1 m/s, by Runge-Kutta steps in the force of
/// a law whose lambda is `loss`.
double restitution(double loss) {
  const ContactNumbers<double> c = numbers(1e4, 1.5, loss);
  const auto acceleration = [&](double depth, double rate) {
    return -force("hunt_crossley", -depth, -rate, c).normal;
  };
  double x = 0.0, v = 1.0;
  constexpr double kStep = 2e-6;
  while (x >= 0.0) {
    const double a1 = acceleration(x, v), v2 = v + 0.5 * kStep * a1,
                 a2 = acceleration(x + 0.5 * kStep * v, v2), v3 = v + 0.5 * kStep * a2,
                 a3 = acceleration(x + 0.5 * kStep * v2, v3), v4 = v + kStep * a3,
                 a4 = acceleration(x + kStep * v3, v4);
    x += kStep / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
    v += kStep / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  return -v;
}

TEST(ContactLaw, RestitutionIsExactOfGonthierAndNearOneOfAll) {
  for (double e : {0.1, 0.5, 0.8, 0.95, 0.9899, 0.9901, 0.999})
    EXPECT_NEAR(restitution(law_of("gonthier").restitution.computed(e)), e, 2e-6) << e;
  EXPECT_EQ(law_of("gonthier").restitution.computed(1.0), 0.0);
  for (const char* name : {"hunt_crossley", "lankarani_nikravesh", "flores"}) {
    EXPECT_NEAR(restitution(law_of(name).restitution.computed(0.95)), 0.95, 0.02) << name;
    EXPECT_EQ(law_of(name).restitution.computed(1.0), 0.0) << name;
  }
  EXPECT_NEAR(restitution(law_of("flores").restitution.computed(0.3)), 0.3, 0.06)
      << "the others are far off there";
  EXPECT_FALSE(law_of("linear").restitution);
}

TEST(ContactLaw, ExactLossSatisfiesItsEquation) {
  for (double e : {0.3, 0.7, 0.98, 0.9899999, 0.9900001, 0.9999}) {
    const double d = law_of("gonthier").restitution.computed(e);
    EXPECT_NEAR(std::log1p(d) - std::log1p(-e * d), d * (1.0 + e), 1e-12 * d) << e;
    EXPECT_GT(d, 1.5 * (1.0 - e)) << "not the root at zero";
  }
}

}  // namespace
}  // namespace codesign
