// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// What the readers say of models and studies that are wrong: the cases are data, the YAML files
// below test/reading. A file maps tests to
//   study or robot  a text in which each case puts its own text in place of "<>"; without it each
//                   case has a whole text of its own
//   cases           a list of
//     put           the text for "<>"; or `study`, `robot`: the whole text
//     says          parts of the message, or `nothing`: the model is read without a warning
//     at, line      of a study: the element and the line that the error names
//     warning       of a robot: the code of the one warning that says so, in place of an error
//     overlays      of a robot: a list of {file's name: text}
//     name          of the robot's file, if not test.urdf
// In a robot's texts [robot] stands for the first line of robot_text(), [inertial] for kInertial.
// read_study() gets study_robot() of study_fixture.h.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>

#include "paths.h"
#include "reading/study/study_fixture.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

void put_all(std::string* text, const std::string& mark, const std::string& by) {
  for (std::size_t at = text->find(mark); at != std::string::npos; at = text->find(mark, at))
    text->replace(at, mark.size(), by);
}

std::string filled(std::string text) {
  static const std::string kFirst = robot_text("").text;
  put_all(&text, "[robot]", kFirst.substr(0, kFirst.find('\n')));
  put_all(&text, "[inertial]", kInertial);
  return text;
}

/// The text of a case, in the frame that its test gives.
std::string text_of(const YAML::Node& test, const YAML::Node& given, const char* kind) {
  if (!given["put"]) return given[kind].as<std::string>();
  auto text = test[kind].as<std::string>();
  const std::size_t place = text.find("<>");
  EXPECT_NE(place, std::string::npos) << text;
  return text.replace(place, 2, given["put"].as<std::string>());
}

void check_robot(const YAML::Node& test, const YAML::Node& given) {
  const SourceText urdf{given["name"].as<std::string>("test.urdf"),
                        filled(text_of(test, given, "robot"))};
  std::vector<SourceText> overlays;
  for (const YAML::Node& overlay : given["overlays"])
    overlays.push_back({overlay.begin()->first.as<std::string>(),
                        filled(overlay.begin()->second.as<std::string>())});
  const YAML::Node says = given["says"];
  std::vector<std::string> parts;
  if (says.IsSequence())
    parts = says.as<std::vector<std::string>>();
  else
    parts = {says.as<std::string>()};
  if (parts[0] == "nothing")
    expect_no_warning(urdf, overlays);
  else if (given["warning"])
    expect_warning(urdf, given["warning"].as<std::string>(), parts, overlays);
  else
    expect_error(urdf, parts, overlays);
}

void check(const YAML::Node& test, const YAML::Node& given) {
  if (given["at"])
    expect_fault(text_of(test, given, "study"), given["at"].as<std::string>(),
                 given["says"].as<std::string>(), given["line"].as<int>());
  else
    check_robot(test, given);
}

class Message : public testing::Test {
 public:
  explicit Message(std::function<void()> body) : body_(std::move(body)) {}
  void TestBody() override { body_(); }

 private:
  std::function<void()> body_;
};

void add(const std::string& suite, const std::string& name, const std::string& file, int line,
         const std::function<void()>& body) {
  testing::RegisterTest(suite.c_str(), name.c_str(), nullptr, nullptr, file.c_str(), line,
                        [body]() -> testing::Test* { return new Message(body); });
}

/// One test for each case: StudyMotionMessages.RefusesWhatIsNoMotion_3 is the third one of
/// StudyMotion.RefusesWhatIsNoMotion.
void add_file(const std::string& file) {
  for (const auto& entry : YAML::LoadFile(file)) {
    const auto name = entry.first.as<std::string>();
    const std::size_t dot = name.find('.');
    const YAML::Node test = entry.second;
    int number = 0;
    for (const YAML::Node& given : test["cases"])
      add(name.substr(0, dot) + "Messages", name.substr(dot + 1) + "_" + std::to_string(++number),
          file, given.Mark().line + 1, [test, given] { check(test, given); });
  }
}

const bool kAdded = [] {
  std::vector<std::string> files;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(source_dir() + "/test/reading"))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) {
    try {
      add_file(file);
    } catch (const std::exception& error) {
      add("Messages", "CanBeRead", file, 1,
          [what = std::string(error.what()), file] { FAIL() << file << ": " << what; });
    }
  }
  return !files.empty();
}();

TEST(Messages, AreInFiles) { EXPECT_TRUE(kAdded); }

}  // namespace
}  // namespace codesign
