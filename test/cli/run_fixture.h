// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/report.h"
#include "paths.h"

namespace codesign::cli {

struct Outcome {
  int code = -1;
  std::string out, err;
};

inline Outcome run_words(const std::vector<std::string>& words, bool cancelled = false) {
  std::ostringstream out, err;
  const std::atomic<bool> cancel{cancelled};
  Outcome outcome;
  outcome.code = run(words, {out, err, cancel});
  outcome.out = out.str();
  outcome.err = err.str();
  return outcome;
}

/// The one JSON object on standard output.
inline Json json_of(const Outcome& outcome) {
  Json object = Json::parse(outcome.out, nullptr, false);
  EXPECT_TRUE(object.is_object()) << outcome.out << outcome.err;
  return object;
}

inline std::string shipped(const std::string& path) { return source_dir() + "/" + path; }

inline std::string read_text_file(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file.good()) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A temporary folder of the running test, removed at its end. Test programs that run at the same
/// time have different ones.
class ScratchFolder {
 public:
  ScratchFolder() {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::string name =
        std::string(test->test_suite_name()) + "_" + test->name() + "_" + std::to_string(getpid());
    path_ = std::filesystem::path(testing::TempDir()) / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string path(const std::string& name) const { return (path_ / name).string(); }

  /// Writes `text` with the first `from` replaced by `to`, and returns the file's path.
  std::string edited(const std::string& name, std::string text, const std::string& from,
                     const std::string& to) const {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    std::ofstream(path(name)) << text;
    return path(name);
  }

 private:
  std::filesystem::path path_;
};

}  // namespace codesign::cli
