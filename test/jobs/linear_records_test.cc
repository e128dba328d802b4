// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/linear_records.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

LinearModel example() {
  LinearModel model;
  model.verdict = "stable: ...";
  model.system.period = 0.5;
  model.system.states = {"x/position"};
  model.system.A.setConstant(1, 1, 0.25);
  model.joints = {"x"};
  Pole pole;
  pole.value = std::log(0.25) / 0.5;
  model.modes.push_back({pole, {1.0}});
  ControllerLoop loop;
  loop.controller = "servo";
  loop.samples = 4;
  loop.margins.gain_margin = AtFrequency{3.0, 1.5};
  loop.frequencies = {1.0};
  loop.response = {{-0.5, 0.25}};
  model.loops = {loop, {"other", 0, {}, {}, {}}};
  return model;
}

TEST(LinearRecords, OfPolesAndMatrices) {
  Json object;
  add_stability(example(), &object);
  add_matrices(example().system, &object);
  EXPECT_EQ(object["stability"], "stable");
  EXPECT_EQ(object["period"], 0.5);
  EXPECT_NEAR(object["modes"][0]["radius"].get<double>(), 0.25, 1e-15);
  EXPECT_EQ(object["modes"][0]["damping_ratio"], 1.0);
  EXPECT_EQ(object["modes"][0]["rates"]["x"], 1.0);
  EXPECT_EQ(object["A"], Json::array({Json::array({0.25})}));
  EXPECT_EQ(object["B"], Json::array());
}

TEST(LinearRecords, OfLoops) {
  const Json loops = loops_json(example());
  EXPECT_EQ(loops["servo"]["gain_margin"], (Json{{"value", 3.0}, {"frequency", 1.5}}));
  EXPECT_FALSE(loops["servo"].contains("delay_margin"));
  EXPECT_EQ(loops["servo"]["samples"], 4);
  EXPECT_EQ(loops["servo"]["response"]["imaginary"], Json::array({0.25}));
  EXPECT_EQ(loops["other"]["samples"], 0);
}

}  // namespace
}  // namespace codesign
