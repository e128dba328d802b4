#include <gtest/gtest.h>
#include <cstdio>
#include <set>
#include "assembly/make_system.h"
#include "cases/shipped.h"
#include "equations/formulas.h"
#include "equations/joint_cases.h"
#include "equations/record_patterns.h"
#include "integration/servo.h"
namespace codesign {
namespace {
void compare(const System& system, const char* name) {
  Formulas<double> formulas(system);
  formulas.set_design(system.parameters());
  State<double> state;
  state.resize(system.layout());
  formulas.load(state);
  PatternRecorder recorder;
  formulas.assemble(&recorder);
  const ByVariable<Sparsity> p = record_patterns(system);
  const auto one = [&](const PatternRecorder::Calls& calls, const Sparsity& s, const char* which) {
    std::set<std::pair<int, int>> old(calls.begin(), calls.end()), now;
    for (int r = 0; r < s.rows; ++r)
      for (int e = s.first(r); e < s.first(r + 1); ++e) now.insert({r, s.column(e)});
    int missing = 0, more = 0;
    for (auto x : old)
      if (!now.count(x)) ++missing;
    for (auto x : now)
      if (!old.count(x)) {
        ++more;
        if (more < 4) std::printf("   more %d %d\n", x.first, x.second);
      }
    std::printf("%s %s: old %zu now %zu, missing %d more %d\n", name, which, old.size(), now.size(), missing, more);
  };
  one(recorder.calls().position, p.position, "q");
  one(recorder.calls().velocity, p.velocity, "v");
  one(recorder.calls().rate, p.rate, "z");
}
TEST(Zz, Compare) {
  for (const char* name : {"slider_crank", "slider_crank_haug", "inverted_pendulum", "governor", "two_link_arm", "arm_limits", "gantry"}) {
    const Shipped shipped(name);
    compare(*make_system(shipped.robot, shipped.study), name);
  }
}
}  // namespace
}  // namespace codesign
