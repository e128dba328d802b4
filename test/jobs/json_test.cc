// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/json.h"

#include <gtest/gtest.h>

#include "mechanism_codesign/version.h"

namespace codesign {
namespace {

TEST(Json, ValuesGoByName) {
  const Eigen::Vector2d values(0.08, -1.5);
  const Json object = by_name({"crank_length", "Kp"}, Eigen::VectorXd(values));
  EXPECT_EQ(object.dump(), R"({"crank_length":0.08,"Kp":-1.5})");
  EXPECT_EQ(by_name({"a"}, std::vector<double>{}).dump(), "{}");
}

TEST(Json, BytesThatAreNoUtf8AreReplaced) {
  EXPECT_EQ(Json::parse(to_text({{"model", "arm\xe4"}}))["model"], "arm\xef\xbf\xbd");
}

TEST(Json, TheVersionComesFirst) {
  EXPECT_EQ(to_text({{"objective", 0.5}}),
            "{\n  \"version\": \"" + std::string(version()) + "\",\n  \"objective\": 0.5\n}\n");
  EXPECT_EQ(Json::parse(to_text(Json::parse(to_text(Json::object())))),
            Json({{"version", version()}}));
}

}  // namespace
}  // namespace codesign
