// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/yaml/yaml_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace codesign {
namespace {

YamlValue parse(const std::string& text) { return YamlValue::parse({"file.yaml", text}); }

InputFault fault_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "no error";
  return {};
}

TEST(YamlReader, KnowsPathsAndLines) {
  const YamlValue root = parse("a:\n  b:\n    - 1\n    - {c: 2.5}\n");
  const YamlValue item = root.at("a").at("b").items().at(1).at("c");
  EXPECT_EQ(item.path(), "a.b[1].c");
  EXPECT_EQ(item.where().line, 4);
  EXPECT_EQ(item.where().file, "file.yaml");
  EXPECT_EQ(item.number(), 2.5);
}

TEST(YamlReader, ReadsNumbersWhateverTheirQuotes) {
  EXPECT_EQ(parse("[1.0e-6, '1e-6', +2, -.5, 3]").items().at(1).number(), 1e-6);
  EXPECT_EQ(number_in("+2"), 2.0);
  EXPECT_EQ(number_in("-.5"), -0.5);
  EXPECT_FALSE(number_in("2 m").has_value());
  EXPECT_FALSE(number_in("+-2").has_value());
  EXPECT_FALSE(number_in("").has_value());
  EXPECT_TRUE(std::isinf(number_in("-.inf").value()));
  EXPECT_TRUE(std::isnan(number_in(".nan").value()));
}

TEST(YamlReader, RefusesOtherKinds) {
  const YamlValue root = parse("map: {}\nlist: []\nword: abc\nhuge: .inf\nhalf: 0.5\nnothing:\n");
  EXPECT_EQ(fault_of([&] { root.at("map").number(); }).message, "expected a number, found a map");
  EXPECT_EQ(fault_of([&] { root.at("list").text(); }).message, "expected text, found a list");
  EXPECT_EQ(fault_of([&] { root.at("word").items(); }).message, "expected a list, found a scalar");
  EXPECT_EQ(fault_of([&] { root.at("nothing").entries(); }).message,
            "expected a map of keys and values, found nothing");
  EXPECT_EQ(fault_of([&] { root.at("huge").number(); }).message, "not finite");
  EXPECT_EQ(fault_of([&] { root.at("half").integer(); }).message, "not an integer");
  for (const char* no_number : {"1.2.3", "2024-01-01", "1e", "--1"})
    EXPECT_EQ(fault_of([&] { parse(std::string("x: ") + no_number).at("x").number(); }).message,
              "not a number");
  for (const char* huge : {"1e999", "+1e999", "-1.5e999"})
    EXPECT_EQ(fault_of([&] { parse(std::string("x: ") + huge).at("x").number(); }).message,
              "the number is out of the range of floating point");
  const InputFault fault = fault_of([&] { root.at("word").number(); });
  EXPECT_EQ(fault.message, "not a number");
  EXPECT_EQ(fault.element, "word");
  EXPECT_EQ(fault.value, "abc");
  EXPECT_EQ(fault.where.line, 3);
}

TEST(YamlReader, ChecksKeys) {
  const YamlValue root = parse("x: 1\nnested:\n  wieght:\n    deep: 1\n");
  const InputFault unknown = fault_of([&] {
    root.at("nested").require_keys({}, {"weight", "reference"});
  });
  EXPECT_EQ(unknown.element, "nested.wieght");
  EXPECT_EQ(unknown.where.line, 3);
  EXPECT_EQ(unknown.message, "unknown key, did you mean \"weight\"?");
  EXPECT_EQ(unknown.allowed, "weight, reference");
  const InputFault missing = fault_of([&] {
    root.at("nested").require_keys({"wieght", "signal"}, {});
  });
  EXPECT_EQ(missing.element, "nested.signal");
  EXPECT_EQ(missing.message, "required key is missing");
  EXPECT_NE(missing.allowed, "");
  EXPECT_EQ(fault_of([&] { parse("a: 1\nb: 2\na: 3\n").entries(); }).where.line, 3);
  EXPECT_EQ(fault_of([&] { parse("? [a, b]\n: 3\n").entries(); }).message,
            "a key must be a plain word, found a list");
}

TEST(YamlReader, MergesMapsKeyByKey) {
  const YamlValue root = parse(
      "base:\n  a: {x: 1, y: 2}\n  b: [1, 2]\n  c: 3\nchange:\n  d: 4\n  b: [5]\n  a:\n    y: 6\n");
  const YamlValue merged = root.at("base").merged(root.at("change"));
  std::vector<std::string> keys;
  for (const auto& [key, value] : merged.entries()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_EQ(merged.entries().at(0).second.at("y").number(), 6.0);
  EXPECT_EQ(merged.at("a").at("x").path(), "base.a.x");
  EXPECT_EQ(merged.at("a").at("x").where().line, 2);
  EXPECT_EQ(merged.at("a").at("y").path(), "change.a.y");
  EXPECT_EQ(merged.at("a").at("y").where().line, 9);
  EXPECT_EQ(merged.at("a").key_place("y").line, 9);
  EXPECT_EQ(merged.at("a").key_place("x").line, 2);
  EXPECT_EQ(merged.at("b").items().size(), 1U);
  EXPECT_EQ(merged.at("c").number(), 3.0);
  EXPECT_EQ(merged.path(), "change");
  merged.require_keys({"a", "b", "c", "d"}, {});
  EXPECT_EQ(fault_of([&] { merged.require_keys({"a", "b", "d"}, {}); }).element, "base.c");
  EXPECT_EQ(root.at("base").at("a").at("y").number(), 2.0);
  EXPECT_EQ(root.at("base").entries().size(), 3U);
}

TEST(YamlReader, AMapOfAnotherTypeReplacesTheWhole) {
  const YamlValue root = parse(
      "{base: {f: {type: sine, phase: 1}}, same: {f: {type: sine, offset: 2}}, other: {f: {type: "
      "line, slope: 2}}, none: {f: 3}}");
  EXPECT_EQ(root.at("base").merged(root.at("same")).at("f").entries().size(), 3U);
  const YamlValue other = root.at("base").merged(root.at("other")).at("f");
  EXPECT_EQ(other.entries().size(), 2U);
  EXPECT_FALSE(other.find("phase").has_value());
  EXPECT_EQ(root.at("base").merged(root.at("none")).at("f").number(), 3.0);
}

TEST(YamlReader, RefusesTextThatIsNotOneDocument) {
  EXPECT_EQ(fault_of([] { parse("a: [1, 2\nb: 3\n"); }).message.substr(0, 8), "not YAML");
  EXPECT_EQ(fault_of([] { parse("a: 1\n\tb: 3\n"); }).where.line, 2);
  EXPECT_EQ(fault_of([] { parse(""); }).message, "the file contains no YAML");
  EXPECT_EQ(fault_of([] { parse(""); }).allowed, "a map of keys and values, such as duration: 2.0");
  EXPECT_EQ(fault_of([] { parse("a: 1\n---\nb: 1\n"); }).message, "more than one YAML document");
}

}  // namespace
}  // namespace codesign
