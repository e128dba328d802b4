// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/fold_chain.h"

#include <gtest/gtest.h>

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// One joint of a chain: its type, its axis, and its origin in the frame of the one before.
struct Element {
  const char* type;
  const char* axis;
  const char* xyz = "0 0 0";
};

/// A chain from the ground across massless links to an arm.
Topology topology(const std::vector<Element>& elements, const std::string& more = "") {
  std::string text = kGround;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const bool last = k + 1 == elements.size();
    const std::string parent = k == 0 ? "ground" : "m" + std::to_string(k - 1),
                      child = last ? "arm" : "m" + std::to_string(k);
    text += link_with(child, last ? kInertial : "") +
            joint_with("j" + std::to_string(k), elements[k].type, parent, child,
                       "<origin xyz='" + std::string(elements[k].xyz) + "'/><axis xyz='" +
                           elements[k].axis + "'/><limit effort='1' velocity='1'/>" + more);
  }
  return derive_topology(read_urdf(robot_text(text)));
}

/// The kind of pair that the chain is folded into.
PairKind fold(const std::vector<Element>& elements) { return topology(elements).pairs.at(0).kind; }

constexpr const char *kTurn = "continuous", *kSlide = "prismatic", *kX = "1 0 0", *kY = "0 1 0",
                     *kZ = "0 0 1";

TEST(FoldChain, OneJointIsItself) {
  EXPECT_EQ(fold({{kTurn, kX}}), PairKind::kRevolute);
  EXPECT_EQ(fold({{kSlide, kX}}), PairKind::kPrismatic);
  EXPECT_EQ(fold({{"planar", kX}}), PairKind::kPlanar);
  EXPECT_EQ(fold({{"floating", kX}}), PairKind::kFree);
}

TEST(FoldChain, TurnsThroughOnePoint) {
  EXPECT_EQ(fold({{kTurn, kX}, {kTurn, kY}}), PairKind::kUniversal);
  EXPECT_EQ(fold({{kTurn, kX}, {kTurn, "0.3 0.4 0"}}), PairKind::kUniversal)
      << "the axes need not be normal to each other";
  EXPECT_EQ(fold({{kTurn, kX}, {kTurn, kY, "0.2 0 0"}}), PairKind::kUniversal)
      << "a joint frame may stand anywhere on the axes";
  EXPECT_EQ(fold({{kTurn, kX}, {kTurn, kY}, {kTurn, kZ}}), PairKind::kSpherical);
  EXPECT_EQ(fold({{kTurn, kX}, {kTurn, kY}, {kTurn, kX}}), PairKind::kSpherical);
}

TEST(FoldChain, Slides) {
  EXPECT_EQ(fold({{kSlide, kX}, {kSlide, kY, "0 0 1"}}), PairKind::kTable);
  EXPECT_EQ(fold({{kSlide, kX}, {kSlide, "0.1 0.1 0"}, {kSlide, kZ}}), PairKind::kTranslational);
}

TEST(FoldChain, TurnsAndSlides) {
  EXPECT_EQ(fold({{kTurn, kZ}, {kSlide, kZ, "0 0 2"}}), PairKind::kCylindrical);
  EXPECT_EQ(fold({{kSlide, "0 0 -1"}, {kTurn, kZ}}), PairKind::kCylindrical);
  for (const auto& order : {std::vector<Element>{{kSlide, kX}, {kSlide, kY}, {kTurn, kZ}},
                            {{kTurn, kZ}, {kSlide, kX}, {kSlide, kY}}})
    EXPECT_EQ(fold(order), PairKind::kPlanar);
  EXPECT_EQ(fold({{kSlide, kX}, {kSlide, kY}, {kSlide, kZ}, {kTurn, kX}, {kTurn, kY}, {kTurn, kZ}}),
            PairKind::kFree);
}

TEST(FoldChain, LinksOfWhatIsNoJointAreBodiesWithoutMass) {
  const std::vector<std::vector<Element>> chains{
      {{kTurn, kX}, {kTurn, kX}},                        // twice the same turn
      {{kTurn, kX}, {kTurn, kX, "0 1 0"}},               // parallel hinges
      {{kTurn, kX}, {kTurn, kY, "0 0 0.1"}},             // hinges that miss each other
      {{kTurn, kX}, {kTurn, kY}, {kTurn, kZ, "1 1 0"}},  // the third passes by
      {{kSlide, kX}, {kSlide, kX}},                      // twice the same slide
      {{kSlide, kX}, {kSlide, kY}, {kSlide, "1 1 0"}},   // three slides in one plane
      {{kTurn, kX}, {kSlide, kY}},                       // a slide across the axis of a turn
      {{kTurn, kX}, {"planar", kZ}},                     // no chain of simple joints
  };
  for (const std::vector<Element>& chain : chains) {
    const Topology t = topology(chain);
    EXPECT_EQ(t.pairs.size(), chain.size())
        << "folded a chain that ends in " << chain.back().type << " " << chain.back().axis;
    EXPECT_EQ(t.bodies.size(), chain.size());
  }
}

TEST(FoldChain, AJointThatCarriesALoadKeepsItsCoordinate) {
  // A ball of three hinges at other than right angles has no closed form for each hinge.
  const std::vector<Element> skew{{kTurn, kX}, {kTurn, "0.6 0.8 0"}, {kTurn, kZ}};
  EXPECT_EQ(fold(skew), PairKind::kSpherical);
  EXPECT_EQ(topology(skew, "<dynamics damping='0.1'/>").pairs.size(), 3U)
      << "damped hinges are not folded";
  EXPECT_EQ(
      topology({{kTurn, kX}, {kTurn, kY}, {kTurn, kZ}}, "<dynamics damping='0.1'/>").pairs.size(),
      1U)
      << "their angles can be read";
}

}  // namespace
}  // namespace codesign
