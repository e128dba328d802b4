// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "jobs/json.h"
#include "mechanism_codesign/error.h"
#include "ros/apply/apply.h"

namespace codesign {
namespace {

TEST(ApplyArgumentsOfALine, AreReadInBothSpellings) {
  const ApplyArguments arguments = parse_apply_arguments(
      {"job", "--ramp", "0.5", "--hold=2", "--limit", "elbow/effort=-2:2", "--limit=/t=0:1",
       "--server=/simulation", "--deviation", "0.1", "--dry-run", "--json"});
  EXPECT_EQ(arguments.request.result, "job");
  EXPECT_EQ(arguments.request.ramp, 0.5);
  EXPECT_EQ(arguments.request.hold, 2.0);
  EXPECT_EQ(arguments.request.deviation, 0.1);
  EXPECT_EQ(arguments.request.limits, (std::vector<std::string>{"elbow/effort=-2:2", "/t=0:1"}));
  EXPECT_EQ(arguments.request.server, "/simulation");
  EXPECT_TRUE(arguments.request.dry_run && arguments.json);
  EXPECT_FALSE(arguments.request.unwatched);
}

TEST(ApplyArgumentsOfALine, MistakesAreNamed) {
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{}, "needs the DIR or BAG"},
      {{"job", "other"}, "unexpected \"other\""},
      {{"job", "--rmap", "1"}, "unknown option \"--rmap\", did you mean \"--ramp\"?"},
      {{"job", "--ramp"}, "--ramp needs a value"},
      {{"job", "--ramp="}, "--ramp needs a value"},
      {{"job", "--ramp", "fast"}, "\"fast\" is not a number above zero"},
      {{"job", "--hold", "-1"}, "\"-1\" is not a number above zero"},
      {{"job", "--dry-run=yes"}, "--dry-run takes no value"},
      {{""}, "an empty argument"}};
  for (const auto& [words, message] : cases) {
    try {
      parse_apply_arguments(words);
      FAIL() << message;
    } catch (const ApplyUsageError& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }
}

TEST(ApplyArgumentsOfALine, TheHelpNamesEveryOption) {
  EXPECT_TRUE(parse_apply_arguments({"--help"}).help);
  for (const char* option : {"--dry-run", "--server", "--ramp", "--hold", "--limit", "--deviation",
                             "--joint-states", "--max-age", "--unwatched", "--json"})
    EXPECT_NE(apply_usage().find(option), std::string::npos) << option;
  std::istringstream lines(apply_usage());
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
}

TEST(ApplyAnswer, IsATableOrJson) {
  mechanism_codesign::ApplyResponse response;
  response.success = true;
  response.message = "done";
  response.rollback_seconds = std::numeric_limits<double>::quiet_NaN();
  response.changes.resize(1);
  response.changes[0].server = "/arm/gains/elbow";
  response.changes[0].name = "p";
  response.changes[0].before = 1.0;
  response.changes[0].after = response.changes[0].now = 0.1;
  EXPECT_NE(apply_table(response).find(
                "/arm/gains/elbow  p                      1            0.1            0.1\ndone\n"),
            std::string::npos)
      << apply_table(response);
  Json object = Json::parse(apply_json(response));
  EXPECT_EQ(object["changes"][0]["after"], 0.1);
  EXPECT_TRUE(object["rollback_seconds"].is_null());
  EXPECT_FALSE(object.contains("error"));
  response.success = false;
  response.code = "aborted";
  object = Json::parse(apply_json(response));
  EXPECT_EQ(object["error"]["code"], "aborted");
}

using mechanism_codesign::ApplyRequest;

template <class Read>
std::string refusal_of(const Read& read, const ApplyRequest& request) {
  try {
    read(request);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ApplyOptions, ZeroIsTheDefault) {
  EXPECT_EQ(ramp_options({}).ramp, 2.0);
  EXPECT_EQ(ramp_options({}).hold, 1.0);
  EXPECT_EQ(watch_options({}).max_age, 0.5);
  EXPECT_EQ(watch_options({}).joint_states, "joint_states");
}

TEST(ApplyOptions, ATimeThatIsNoneIsRefusedWithItsRange) {
  for (double ApplyRequest::*field :
       {&ApplyRequest::ramp, &ApplyRequest::hold, &ApplyRequest::max_age}) {
    const auto read = [](const ApplyRequest& request) {
      ramp_options(request);
      watch_options(request);
    };
    ApplyRequest request;
    request.*field = 1e5;
    EXPECT_EQ(refusal_of(read, request), "accepted");
    for (const double wrong : {100000.5, 2e8, -1.0, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
      request.*field = wrong;
      const std::string sentence = refusal_of(read, request);
      EXPECT_NE(sentence.find("not a time"), std::string::npos) << sentence;
      EXPECT_NE(sentence.find("up to 100000 s"), std::string::npos) << sentence;
    }
  }
}

TEST(ApplyOptions, NothingIsBothNamedAndUnwatched) {
  ApplyRequest request;
  request.unwatched = true;
  EXPECT_EQ(watch_options(request).joint_states, "");
  request.deviation = 0.1;
  EXPECT_NE(refusal_of(watch_options, request).find("left unwatched"), std::string::npos);
  request.unwatched = false;
  EXPECT_EQ(watch_options(request).deviation, 0.1);
  request.deviation = -0.1;
  EXPECT_NE(refusal_of(watch_options, request).find("deviation"), std::string::npos);
}

}  // namespace
}  // namespace codesign
