// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/option_tables.h"

#include <gtest/gtest.h>

#include <map>
#include <type_traits>

#include "edited_text.h"
#include "reading/page_rows.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// What doc/study/ says of a key.
struct PageOption {
  std::string sentence, standard;
};

/// Compares the rows of one block with its page.
struct PageCheck {
  std::string block;
  std::map<std::string, PageOption>& left;  ///< rows that no option has claimed

  PageOption claim(const std::string& key) const {
    const auto row = left.find(block + "." + key);
    if (row == left.end()) {
      ADD_FAILURE() << "doc/study/ has no row for " << block << "." << key;
      return {};
    }
    PageOption found = row->second;
    left.erase(row);
    return found;
  }
  void operator()(const std::string& key, bool& option) const {
    EXPECT_EQ(claim(key).standard, option ? "true" : "false") << key;
  }
  /// For a default of zero the page may have words, such as "chosen" or "4 · `starts`".
  template <class Number>
  void operator()(const std::string& key, const OptionRange& range, Number& option) const {
    const PageOption row = claim(key);
    const bool is_formula = row.standard.find('`') != std::string::npos;
    const std::optional<double> number =
        parse_number(row.standard.substr(0, row.standard.find_first_of(" :")));
    EXPECT_EQ(is_formula ? 0.0 : number.value_or(0.0), static_cast<double>(option))
        << block << "." << key;
    if (row.sentence.rfind("as in ", 0) == 0) return;
    for (const double bound : {range.least, range.most}) {
      const bool is_said = bound == 0.0 || bound == 1.0 || bound >= std::numeric_limits<int>::max();
      const std::string text = bound < 1.0 ? replaced_all(to_decimal(bound), "e-0", "e-")
                                           : split_at(std::to_string(bound), "\\.")[0];
      EXPECT_TRUE(is_said || row.sentence.find(text) != std::string::npos)
          << block << "." << key << ": " << text;
    }
  }
  void operator()(const std::string& key, LossKind& option) const {
    const PageOption row = claim(key);
    for (const auto& [name, kind] : fit_losses()) {
      EXPECT_NE(row.sentence.find("`" + name + "`"), std::string::npos) << key << ": " << name;
      EXPECT_EQ(kind == option, row.standard.rfind("`" + name + "`", 0) == 0) << key << name;
    }
  }
  /// A number that follows the machine where it is not given.
  void operator()(const std::string& key, const OptionRange&, std::optional<double>& option) const {
    EXPECT_NE(claim(key).standard.find("follows the machine"), std::string::npos) << key;
    EXPECT_FALSE(option) << key;
  }
  template <class Option, std::size_t N>
  void operator()(const std::string& key, const std::array<const char*, N>& names,
                  Option& option) const {
    const PageOption row = claim(key);
    std::string standard;
    if constexpr (std::is_enum_v<Option>)
      standard = names.at(static_cast<std::size_t>(option));
    else
      standard = option;
    EXPECT_EQ(row.standard.rfind("`" + standard + "`", 0), 0U) << block << "." << key;
    if (row.sentence.rfind("as in ", 0) == 0) return;
    for (const char* name : names)
      EXPECT_NE(row.sentence.find("`" + std::string(name) + "`"), std::string::npos)
          << block << "." << key << ": " << name;
  }
};

/// Entries of lists and maps in a block are compared by entry_keys_test.cc. @param others keys of
/// the block that are no options.
template <class Options>
void expect_on_page(const std::string& block, const std::vector<std::string>& others = {}) {
  const std::string prefix = block + ".";
  std::map<std::string, PageOption> left;
  for (const PageRow& row : study_rows())
    for (std::size_t k = 0; k < row.keys.size(); ++k)
      if (row.keys[k].rfind(prefix, 0) == 0 &&
          row.keys[k].find('.', prefix.size()) == std::string::npos)
        left.emplace(row.keys[k], PageOption{row.cells[0], row.part(1, k)});
  Options defaults;
  visit_options(PageCheck{block, left}, &defaults);
  for (const std::string& other : others) left.erase(std::string(prefix).append(other));
  for (const auto& [key, row] : left)
    ADD_FAILURE() << "no option of the code is " << key << " of doc/study/";
}

TEST(OptionTables, AreThoseOfThePage) {
  expect_on_page<LimitOptions>("limits");
  expect_on_page<SolverOptions>("solver");
  expect_on_page<OptimizerOptions>("optimizer");
  expect_on_page<RobustOptions>("robust");
  expect_on_page<MultistartOptions>("multistart");
  expect_on_page<EngineOptions>("engine");
  expect_on_page<FilterOptions>("identify.filter");
  expect_on_page<LossOptions>("identify.loss");
  expect_on_page<IntervalOptions>("identify.intervals");
  expect_on_page<ExcitationDescription>("excite", {"noise"});
}

TEST(OptionRange, SaysItsBounds) {
  EXPECT_EQ(kZeroOrMore.in_words(), "0 or more");
  EXPECT_EQ(kAboveZero.in_words(), "more than 0");
  EXPECT_EQ(kProperFraction.in_words(), "more than 0 and less than 1");
  EXPECT_EQ(kRelativeTolerance.in_words(), "from 1e-13 to less than 1");
  EXPECT_EQ((OptionRange{1, 4}.in_words()), "a whole number from 1 to 4");
  EXPECT_TRUE(kZeroOrMore.holds(0.0) && !kAboveZero.holds(0.0) && kAboveZero.holds(1e-300));
  EXPECT_TRUE(!kProperFraction.holds(1.0) && kRelativeTolerance.holds(1e-13) &&
              !kRelativeTolerance.holds(1.0));
}

}  // namespace
}  // namespace codesign
