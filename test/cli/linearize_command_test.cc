// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "cli/run_fixture.h"

namespace codesign::cli {
namespace {

// The cart of doc/linearization.md.
struct CartFiles {
  ScratchFolder folder;

  explicit CartFiles(const std::string& keys = ", sample_time: 0.05") {
    const std::string page = read_text_file(shipped("doc/linearization.md"));
    const std::size_t first = page.find("<robot"), last = page.find("</robot>") + 8;
    std::ofstream(folder.path("cart.urdf")) << page.substr(first, last - first);
    std::ofstream(folder.path("cart.yaml"))
        << "duration: 10.0\ncontrollers:\n  servo: {type: pid, input: slide/position, setpoint: "
           "0.0, output: slide, gains: {p: 1.0}, time_constant: 0.5" +
               keys + "}\n";
  }
  Outcome run(std::vector<std::string> options = {}) const {
    std::vector<std::string> words{"linearize", folder.path("cart.urdf"), folder.path("cart.yaml")};
    words.insert(words.end(), options.begin(), options.end());
    return run_words(words);
  }
};

TEST(LinearizeCommand, PrintsWhatItsPageSays) {
  const Outcome outcome = CartFiles().run();
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_NE(read_text_file(shipped("doc/linearization.md")).find(outcome.out), std::string::npos)
      << outcome.out;
}

TEST(LinearizeCommand, HasMarginsAndMatricesInJson) {
  const Json object =
      json_of(CartFiles("").run({"--json", "--signals", "slide/position,servo/error"}));
  EXPECT_EQ(object["stability"], "stable");
  EXPECT_EQ(object["states"], Json({"slide/position", "slide/velocity", "servo/lag"}));
  EXPECT_EQ(object["A"], Json({{0.0, 1.0, 0.0}, {0.0, -1.0, 1.0}, {-2.0, 0.0, -2.0}}));
  EXPECT_EQ(object["C"], Json({{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}}));
  const Json& servo = object["loops"]["servo"];
  EXPECT_NEAR(servo["gain_margin"]["value"].get<double>(), 3.0, 1e-9);
  EXPECT_NEAR(servo["gain_margin"]["frequency"].get<double>(), std::sqrt(2.0), 1e-9);
  EXPECT_FALSE(servo.contains("gain_reduction"));
  EXPECT_EQ(servo["response"]["real"].size(), servo["response"]["frequency"].size());
  EXPECT_EQ(object["measured"], (Json{{"servo", "slide/position"}}));
  EXPECT_FALSE(object.contains("period"));
}

TEST(LinearizeCommand, WritesFrequencyResponses) {
  const CartFiles files("");
  const std::string path = files.folder.path("loops.csv");
  ASSERT_EQ(files.run({"--csv", path}).code, kDone);
  std::istringstream lines(read_text_file(path));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "loop,frequency,real,imaginary");
  int count = 0;
  for (; std::getline(lines, line); ++count) {
    double loop = 0.0, w = 0.0, real = 0.0, imaginary = 0.0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &loop, &w, &real, &imaginary), 4);
    const std::complex<double> s(0.0, w), L = 2.0 / (s * (s + 1.0) * (s + 2.0));
    EXPECT_LT(std::abs(std::complex<double>(real, imaginary) - L), 1e-9 * std::abs(L)) << w;
  }
  EXPECT_GT(count, 300);
}

TEST(LinearizeCommand, AboutAnInstantOfTheRun) {
  const Outcome outcome = CartFiles("").run({"--at", "0.5"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_NE(outcome.out.find("damping, controllers and friction counted"), std::string::npos);
  EXPECT_EQ(CartFiles().run({"--at", "11"}).code, kBadInput);
}

}  // namespace
}  // namespace codesign::cli
