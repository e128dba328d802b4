// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "child_process.h"
#include "cli/arguments.h"
#include "cli/run_fixture.h"
#include "mechanism_codesign/error.h"

namespace codesign::cli {
namespace {

namespace fs = std::filesystem;

/// A gallery of two machines, and a folder that is none.
class NewCommand : public testing::Test {
 protected:
  NewCommand() {
    for (const std::string machine : {"press", "crane"}) {
      fs::create_directories(folder_.path("gallery/" + machine));
      for (const std::string file : {"model.urdf", "study.yaml"})
        std::ofstream(fs::path(folder_.path("gallery")) / machine / file) << machine << ' ' << file;
    }
    std::ofstream(folder_.path("gallery/press/README.md")) << "# A press\n\nmore\n";
    fs::create_directories(folder_.path("gallery/unfinished"));
    std::ofstream(folder_.path("gallery/README.md")) << "# Gallery\n";
  }

  Outcome start(const std::vector<std::string>& words) {
    std::ostringstream out, err;
    const std::atomic<bool> cancel{false};
    Outcome outcome;
    outcome.code =
        start_project(parse_arguments(words), folder_.path("gallery"), {out, err, cancel});
    outcome.out = out.str();
    outcome.err = err.str();
    return outcome;
  }

  void expect_refused(const std::vector<std::string>& words, const std::string& message) {
    try {
      start(words);
      ADD_FAILURE() << message;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }

  ScratchFolder folder_;
};

TEST_F(NewCommand, CopiesModelAndStudy) {
  const std::string mine = folder_.path("my/press");
  const Outcome outcome = start({"new", mine, "--from", "press"});
  EXPECT_EQ(outcome.code, kDone);
  EXPECT_EQ(read_text_file(mine + "/model.urdf"), "press model.urdf");
  EXPECT_EQ(read_text_file(mine + "/study.yaml"), "press study.yaml");
  EXPECT_FALSE(fs::exists(mine + "/README.md"));
  EXPECT_NE(outcome.out.find("  codesign optimize " + mine + "/model.urdf " + mine +
                             "/study.yaml --output " + mine + "/job\n"),
            std::string::npos)
      << outcome.out;
}

TEST_F(NewCommand, PrintsCommandsThatAShellUnderstands) {
  const Json object =
      json_of(start({"new", folder_.path("my 'press'"), "--from", "press", "--json"}));
  ASSERT_EQ(object["commands"].size(), 3U);
  const std::string path = "'" + folder_.path("my '\\''press'\\''");
  EXPECT_EQ(object["commands"][2],
            "codesign report " + path + "/job' -o " + path + "/report.html'");
  EXPECT_EQ(object["files"][1], folder_.path("my 'press'/study.yaml"));
}

TEST_F(NewCommand, ListsTheMachines) {
  EXPECT_EQ(start({"new"}).out, "crane  \npress  A press\n");
  const Json object = json_of(start({"new", "--json"}));
  EXPECT_EQ(object["machines"][1]["name"], "press");
  EXPECT_EQ(object["machines"][1]["title"], "A press");
}

TEST_F(NewCommand, RefusesWhatItDoesNotKnow) {
  const std::string mine = folder_.path("mine");
  expect_refused({"new", mine, "--from", "pres"},
                 "--from: unknown machine, did you mean \"press\"? (value: pres, allowed: crane, "
                 "press)");
  expect_refused({"new", mine, "--from", "../gallery"}, "unknown machine");
  expect_refused({"new", mine}, "--from: the machine to begin with is not given (allowed: crane");
  expect_refused({"new", "--from", "press"}, "the name of the new folder is not given");
  EXPECT_FALSE(fs::exists(mine));
}

TEST_F(NewCommand, ReplacesNothing) {
  const std::string mine = folder_.path("mine");
  fs::create_directories(mine);
  expect_refused({"new", mine, "--from", "press"},
                 "this already exists, and codesign new does not overwrite anything");
  EXPECT_TRUE(fs::is_empty(mine));
  std::ofstream(folder_.path("file")) << "text";
  expect_refused({"new", folder_.path("file"), "--from", "press"},
                 "codesign new does not overwrite anything");
  expect_refused({"new", folder_.path("file/mine"), "--from", "press"}, "cannot be created");
  fs::create_symlink(folder_.path("nowhere"), folder_.path("link"));
  expect_refused({"new", folder_.path("link"), "--from", "press"},
                 "codesign new does not overwrite anything");
}

TEST_F(NewCommand, RefusesANameThatTheSystemDoesNotTake) {
  expect_refused({"new", folder_.path(std::string(300, 'a')), "--from", "press"},
                 "the folder cannot be created");
}

TEST_F(NewCommand, HasItsOwnOptions) {
  EXPECT_EQ(parse_arguments({"new", "mine", "--from=press"}).from, "press");
  EXPECT_THROW(parse_arguments({"new", "mine", "press"}), UsageError);
  EXPECT_THROW(parse_arguments({"new", "mine", "--set", "a=1"}), UsageError);
  EXPECT_THROW(parse_arguments({"check", "mine", "--from", "press"}), UsageError);
}

TEST_F(NewCommand, TheProgramFindsItsGallery) {
  const std::string mine = folder_.path("mine");
  EXPECT_EQ(ChildProcess({codesign_executable(), "new", mine, "--from", "toggle_press"}).wait(),
            kDone);
  EXPECT_EQ(read_text_file(mine + "/study.yaml"),
            read_text_file(shipped("gallery/toggle_press/study.yaml")));
  const std::string errors = folder_.path("errors");
  EXPECT_EQ(
      ChildProcess({codesign_executable(), "new", folder_.path("other"), "--from", "tog_press"},
                   "/dev/null", errors)
          .wait(),
      kBadInput);
  EXPECT_NE(read_text_file(errors).find("did you mean \"toggle_press\"?"), std::string::npos);
}

}  // namespace
}  // namespace codesign::cli
