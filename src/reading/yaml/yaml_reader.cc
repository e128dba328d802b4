// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/yaml/yaml_reader.h"

#include <yaml-cpp/depthguard.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kRoot = "study";

const char* kind_of(const YAML::Node& node) {
  switch (node.Type()) {
    case YAML::NodeType::Map:
      return "a map";
    case YAML::NodeType::Sequence:
      return "a list";
    case YAML::NodeType::Scalar:
      return "a scalar";
    default:
      return "nothing";
  }
}

/// Counts the values; the values of an alias count each time the alias is used. A few lines with
/// nested aliases can stand for more values than fit into memory.
void count_values(const YAML::Node& node, int depth, const std::string& file, int* count) {
  constexpr int kMost = 2000000, kDeepest = 50;
  const SourceLocation where{file, node.Mark().line + 1};
  if (depth > kDeepest)
    throw InputError({where, kRoot, "values are nested too deeply, or an alias contains itself", "",
                      "50 levels"});
  if (++*count > kMost)
    throw InputError({where, kRoot,
                      "too many values, counting those of aliases each time they are used", "",
                      "two million values"});
  for (const auto& part : node) {
    if (node.IsMap()) count_values(part.second, depth + 1, file, count);
    if (node.IsSequence()) count_values(part, depth + 1, file, count);
  }
}

void check_extent(const YAML::Node& root, const std::string& file) {
  int count = 0;
  count_values(root, 0, file, &count);
}

/// Whether a text that parse_number() rejects is a number out of the range of doubles.
bool is_out_of_range(const std::string& text) {
  const char* const end = text.data() + text.size();
  double value = 0.0;
  const auto [last, error] =
      std::from_chars(text.data() + (text.rfind('+', 0) == 0 ? 1 : 0), end, value);
  return last == end && error == std::errc::result_out_of_range;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::optional<double> number_in(const std::string& text) {
  if (text == ".inf" || text == "+.inf" || text == "-.inf")
    return std::copysign(HUGE_VAL, text[0] == '-' ? -1.0 : 1.0);
  if (text == ".nan") return std::nan("");
  return parse_number(text);
}

YamlValue YamlValue::parse(const SourceText& source) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(source.text);
    if (documents.empty() || documents.front().IsNull())
      throw InputError({{source.name, 1},
                        kRoot,
                        "the file contains no YAML",
                        "",
                        "a map of keys and values, such as duration: 2.0"});
    if (documents.size() > 1)
      throw InputError({{source.name, documents[1].Mark().line + 1},
                        kRoot,
                        "more than one YAML document",
                        "",
                        "one"});
    check_extent(documents.front(), source.name);
    return YamlValue(documents.front(), std::make_shared<const std::string>(source.name), "");
  } catch (const YAML::DeepRecursion& error) {
    throw InputError({{source.name, error.mark.line + 1},
                      kRoot,
                      "lists and maps are nested too deeply",
                      "",
                      "a few levels, as the keys of the study need them"});
  } catch (const YAML::Exception& error) {
    const std::string column = "column " + std::to_string(error.mark.column + 1);
    throw InputError(
        {{source.name, std::max(1, error.mark.line + 1)},
         column,
         "not YAML: " + error.msg,
         "",
         "spaces for indentation, a space after each colon and comma, every bracket and "
         "quotation mark closed"});
  }
}

SourceLocation YamlValue::where() const { return {*file_, node_.Mark().line + 1}; }

void YamlValue::fail(const std::string& message, const std::string& allowed) const {
  throw InputError({where(), path_.empty() ? kRoot : path_, message, shown_value(), allowed});
}

std::string YamlValue::shown_value() const {
  constexpr std::size_t kMost = 100;
  if (!node_.IsScalar()) return "";
  return node_.Scalar().size() <= kMost ? node_.Scalar() : node_.Scalar().substr(0, kMost) + "...";
}

YamlValue YamlValue::child(const YAML::Node& node, const std::string& key) const {
  return YamlValue(node, file_, path_.empty() ? key : path_ + "." + key);
}

void YamlValue::require_map() const {
  if (!node_.IsMap())
    fail("expected a map of keys and values, found " + std::string(kind_of(node_)),
         "{key: value, ...}, or lines of key: value that are indented further");
}

SourceLocation YamlValue::key_place(const std::string& key) const {
  for (const auto& entry : node_)
    if (entry.first.Scalar() == key) return {*file_, entry.first.Mark().line + 1};
  return base_ ? base_->key_place(key) : where();
}

YamlValue YamlValue::merged(const YamlValue& change) const {
  if (!is_map() || !change.is_map()) return change;
  const auto type = find("type"), new_type = change.find("type");
  if (type && new_type && type->is_scalar() && new_type->is_scalar() &&
      type->node_.Scalar() != new_type->node_.Scalar())
    return change;
  YamlValue result = change;
  result.base_ = std::make_shared<const YamlValue>(*this);
  return result;
}

std::vector<std::pair<std::string, YamlValue>> YamlValue::entries() const {
  std::vector<std::pair<std::string, YamlValue>> own = own_entries();
  if (!base_) return own;
  std::map<std::string, const YamlValue*> changes;
  for (const auto& [key, value] : own) changes.emplace(key, &value);
  std::vector<std::pair<std::string, YamlValue>> result;
  for (const auto& [key, value] : base_->entries()) {
    const auto change = changes.find(key);
    result.emplace_back(key, change == changes.end() ? value : value.merged(*change->second));
    if (change != changes.end()) changes.erase(change);
  }
  for (const auto& entry : own)
    if (changes.count(entry.first) > 0) result.push_back(entry);
  return result;
}

std::vector<std::pair<std::string, YamlValue>> YamlValue::own_entries() const {
  require_map();
  std::vector<std::pair<std::string, YamlValue>> result;
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const YAML::Node& key_node = entry.first;
    if (!key_node.IsScalar())
      fail("a key must be a plain word, found " + std::string(kind_of(key_node)),
           "key: value, without brackets before the colon");
    const std::string key = key_node.Scalar();
    if (!seen.insert(key).second)
      child(key_node, key).fail("repeated key", "each key once in its block");
    result.emplace_back(key, child(entry.second, key));
  }
  return result;
}

void YamlValue::require_keys(const std::vector<std::string>& required,
                             const std::vector<std::string>& optional) const {
  std::vector<std::string> known = required;
  known.insert(known.end(), optional.begin(), optional.end());
  for (const auto& [key, value] : entries())
    if (!contains(known, key)) throw unknown_name(key_place(key), value.path(), "key", key, known);
  for (const std::string& key : required)
    if (!find(key))
      throw InputError(
          {where(), child(node_, key).path(), "required key is missing", "", key + ": ..."});
}

std::optional<YamlValue> YamlValue::find(const std::string& key) const {
  require_map();
  const YAML::Node node = node_[key];
  std::optional<YamlValue> base = base_ ? base_->find(key) : std::nullopt;
  if (!node.IsDefined()) return base;
  return base ? base->merged(child(node, key)) : child(node, key);
}

YamlValue YamlValue::at(const std::string& key) const {
  std::optional<YamlValue> value = find(key);
  if (!value)
    throw InputError(
        {where(), child(node_, key).path(), "required key is missing", "", key + ": ..."});
  return *value;
}

std::vector<YamlValue> YamlValue::items() const {
  if (!node_.IsSequence())
    fail("expected a list, found " + std::string(kind_of(node_)),
         "[..., ...], or lines that begin with a hyphen");
  std::vector<YamlValue> result;
  for (std::size_t i = 0; i < node_.size(); ++i)
    result.push_back(YamlValue(node_[i], file_, path_ + "[" + std::to_string(i) + "]"));
  return result;
}

std::string YamlValue::text() const {
  if (!node_.IsScalar())
    fail("expected text, found " + std::string(kind_of(node_)), "one word or number");
  if (node_.Scalar().empty()) fail("the text is empty", "at least one character, or no such key");
  return node_.Scalar();
}

double YamlValue::number() const {
  if (!node_.IsScalar())
    fail("expected a number, found " + std::string(kind_of(node_)), "a finite number");
  const std::optional<double> value = number_in(node_.Scalar());
  if (!value && is_out_of_range(node_.Scalar()))
    fail("the number is out of the range of floating point", "a finite number");
  if (!value) fail("not a number", "a finite number");
  if (!std::isfinite(*value)) fail("not finite", "a finite number");
  return *value;
}

int YamlValue::integer() const {
  const double value = number();
  if (value != std::floor(value) || std::abs(value) > 1e9) fail("not an integer", "an integer");
  return static_cast<int>(value);
}

bool YamlValue::boolean() const {
  bool value = false;
  if (!YAML::convert<bool>::decode(node_, value)) fail("not a truth value", "true or false");
  return value;
}

std::string YamlValue::choice(const std::string& kind,
                              const std::vector<std::string>& allowed) const {
  std::string name = text();
  if (!contains(allowed, name)) throw unknown_name(where(), path_, kind, name, allowed);
  return name;
}

}  // namespace codesign
