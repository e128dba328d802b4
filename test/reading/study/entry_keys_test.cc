// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/entry_keys.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "reading/page_rows.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

std::vector<EntryForm> all_forms() {
  std::vector<EntryForm> all;
  for (const std::vector<EntryForm>& forms :
       {forms_of_starts(), forms_of_parameters(), forms_of_runs(), forms_of_loads(),
        forms_of_terms(), forms_of_watched_signals(), forms_of_linear_numbers(),
        forms_of_constraints(), forms_of_controllers(), forms_of_recordings(),
        forms_of_calibrations(), forms_of_excited_joints(), forms_of_hardware(),
        forms_of_uncertain()})
    all.insert(all.end(), forms.begin(), forms.end());
  return all;
}

/// The keys of each block by the tables of the pages; `data[].set.PARAMETER` is a key of
/// `data[].set`, and `set` one of `data[]`.
std::map<std::string, std::set<std::string>> keys_on_pages() {
  std::map<std::string, std::set<std::string>> keys;
  for (const PageRow& row : study_rows())
    for (std::string path : row.keys)
      for (std::size_t dot = path.rfind('.'); dot != std::string::npos; dot = path.rfind('.')) {
        std::string key = path.substr(dot + 1);
        path.erase(dot);
        keys[path].insert(key.substr(0, key.find("[]")));
      }
  return keys;
}

/// Blocks whose pages name the keys that they share with another block there.
const std::map<std::string, std::vector<std::string>>& shared_blocks() {
  static const std::map<std::string, std::vector<std::string>> kBlocks{
      {"constraints[]", {"path[]"}},
      {"objective.peak[]", {"path[]"}},
      {"objective.stroke[]", {"path[]", "objective.peak[]"}},
      {"objective.maximum[]", {"path[]", "objective.peak[]"}},
      {"objective.minimum[]", {"path[]", "objective.peak[]"}},
      {"objective.arrival[]", {"path[]", "objective.peak[]", "constraints[]"}},
      {"objective.dwell[]", {"path[]", "objective.peak[]", "constraints[]"}},
      {"objective.loop[]", {"constraints[]", "objective.peak[]"}},
      {"objective.poles[]", {"constraints[]", "objective.peak[]"}}};
  return kBlocks;
}

TEST(EntryKeys, AreThoseOfThePages) {
  std::map<std::string, std::set<std::string>> on_pages = keys_on_pages(), known;
  for (const EntryForm& form : all_forms()) {
    std::vector<std::string> blocks{form.block};
    if (const auto more = shared_blocks().find(form.block); more != shared_blocks().end())
      blocks.insert(blocks.end(), more->second.begin(), more->second.end());
    for (const std::vector<std::string>* keys : {&form.required, &form.optional})
      for (const std::string& key : *keys) {
        bool is_found = false;
        for (const std::string& block : blocks) is_found = is_found || on_pages[block].count(key);
        EXPECT_TRUE(is_found) << "doc/study/ has no row for " << form.block << "." << key;
        for (const std::string& block : blocks) known[block].insert(key);
      }
  }
  for (const auto& [block, keys] : known)
    for (const std::string& key : on_pages[block])
      EXPECT_TRUE(keys.count(key)) << "no row of the code is " << block << "." << key;
}

struct Numbers {
  double one = 1.0, two = 2.0;
};

YamlValue yaml(const std::string& text) { return YamlValue::parse({"study.yaml", text}); }

TEST(EntryKeys, AreReadInTheOrderOfTheRows) {
  const EntryKeys<Numbers, int> keys{
      {"two", true,
       [](const YamlValue& value, const int&, Numbers* of) { of->two = value.number(); }},
      {"one", false,
       [](const YamlValue& value, const int& factor, Numbers* of) {
         of->one = factor * of->two * value.number();
       }},
      {"three", false, nullptr}};
  Numbers numbers;
  read_entry(yaml("{one: 5, two: 4, three: x}"), keys, 3, &numbers);
  EXPECT_EQ(numbers.one, 60.0);
  EXPECT_EQ(numbers.two, 4.0);
  read_entry(yaml("{two: 7}"), keys, 3, &numbers);
  EXPECT_EQ(numbers.one, 60.0);
  EXPECT_EQ(numbers.two, 7.0);
  EXPECT_THROW(read_entry(yaml("{one: 5}"), keys, 3, &numbers), InputError);
  EXPECT_THROW(read_entry(yaml("{two: 5, twoo: 1}"), keys, 3, &numbers), InputError);
}

TEST(EntryKeys, OfAMemberAreReadIntoIt) {
  struct Named {
    Numbers numbers;
  };
  const EntryKeys<Numbers, int> keys{
      {"two", true, [](const YamlValue& value, const int& factor, Numbers* of) {
         of->two = factor * value.number();
       }}};
  Named named;
  read_entry(yaml("{two: 4}"), of_member(keys, &Named::numbers), 3, &named);
  EXPECT_EQ(named.numbers.two, 12.0);
  EXPECT_THROW(read_entry(yaml("{}"), of_member(keys, &Named::numbers), 3, &named), InputError);
}

struct Bounds {
  std::optional<Quantity> lower, upper;
};

Bounds bounds_in(const std::string& text) {
  static const RobotDescription kRobot = study_robot();
  const ParameterTable table({{"a", 2.0, 0.0, 5.0, "", {}}});
  const Study study;
  Bounds bounds;
  read_entry(yaml(text), bound_keys<Bounds>(), EntryContext{kRobot, table, nullptr, study},
             &bounds);
  require_bounds(yaml(text));
  return bounds;
}

TEST(EntryBounds, AreOneOrTwo) {
  EXPECT_EQ(bounds_in("between: [-1, \"${3*a}\"]").lower->nominal(), -1.0);
  EXPECT_EQ(bounds_in("between: [-1, \"${3*a}\"]").upper->nominal(), 6.0);
  EXPECT_EQ(bounds_in("at_least: 1").lower->nominal(), 1.0);
  EXPECT_FALSE(bounds_in("at_least: 1").upper);
  EXPECT_EQ(bounds_in("{at_least: 1, at_most: 4}").upper->nominal(), 4.0);
}

TEST(EntryBounds, HaveOneForm) {
  for (const char* text : {"{}", "{between: [1, 2], at_most: 3}", "{between: [1]}", "{at_most: b}"})
    EXPECT_THROW(bounds_in(text), InputError) << text;
}

}  // namespace
}  // namespace codesign
