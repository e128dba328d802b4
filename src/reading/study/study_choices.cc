// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "reading/study/study_blocks.h"
#include "recordings/number_table.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr std::size_t kMostRows = 10000;
constexpr const char* kPart = "part";  // the column of a table with the names of its rows

std::string list_rows(const ParameterChoice& choice) {
  constexpr std::size_t kShown = 12;
  std::string text;
  for (std::size_t k = 0; k < std::min(kShown, choice.rows.size()); ++k)
    text += (k == 0 ? "" : ", ") + row_text(choice, k);
  return text + (choice.rows.size() > kShown ? ", ..." : "");
}

void require_rows(const YamlValue& at, const ParameterChoice& choice) {
  if (choice.rows.size() < 2 || choice.rows.size() > kMostRows)
    at.fail("found " + std::to_string(choice.rows.size()) + " to choose from",
            "2 to " + std::to_string(kMostRows));
  std::set<std::vector<double>> known;
  for (std::size_t k = 0; k < choice.rows.size(); ++k)
    if (!known.insert(choice.rows[k]).second)
      at.fail("the same is listed twice: " + row_text(choice, k), "each once");
}

void read_whole_numbers(const YamlValue& at, ParameterChoice* choice) {
  const std::vector<YamlValue> ends = at.items();
  if (ends.size() != 2)
    at.fail("found " + std::to_string(ends.size()) + " numbers",
            "the smallest and the largest whole number: [12, 40]");
  const int first = ends[0].integer(), last = ends[1].integer();
  if (!(first < last) || last - first >= static_cast<int>(kMostRows))
    at.fail("the first whole number must be less than the last, by less than " +
                std::to_string(kMostRows),
            "[12, 40]");
  for (int value = first; value <= last; ++value)
    choice->rows.push_back({static_cast<double>(value)});
}

/// The parameter that the column of a list sets.
int listed_parameter(const std::string& name, const SourceLocation& where,
                     const std::string& element, const Study& study) {
  std::vector<std::string> known;
  for (std::size_t k = 0; k < study.parameters.size(); ++k) {
    known.push_back(study.parameters[k].name);
    if (known.back() == name) return static_cast<int>(k);
  }
  throw unknown_name(where, element, "parameter", name, known);
}

void read_listed_rows(const std::vector<YamlValue>& items, const Study& study,
                      ParameterChoice* choice) {
  std::vector<std::string> names;
  for (const auto& [name, value] : items.front().entries())
    if (name == kPart)
      choice->labels.emplace_back();
    else
      names.push_back(name);
  if (names.empty()) items.front().fail("the row sets no parameter", "{PARAMETER: number, ...}");
  for (const std::string& name : names)
    choice->parameters.push_back(
        listed_parameter(name, items.front().key_place(name), items.front().path(), study));
  const bool has_labels = !choice->labels.empty();
  choice->labels.clear();
  std::vector<std::string> required = names;
  if (has_labels) required.emplace_back(kPart);
  for (const YamlValue& item : items) {
    if (!item.is_map()) item.fail("a row among numbers", "all numbers, or all {PARAMETER: number}");
    item.require_keys(required, {});
    std::vector<double>& row = choice->rows.emplace_back();
    for (const std::string& name : names) row.push_back(item.at(name).number());
    if (has_labels) choice->labels.push_back(item.at(kPart).text());
  }
}

void read_part_table(const YamlValue& at, const Study& study, const FileLoader& files,
                     ParameterChoice* choice) {
  if (!files) at.fail("no file can be read here", "the rows themselves");
  const SourceText source = files({at.text(), at.where(), at.path()});
  const NumberTable table(source.name, source.text, CellDelimiter::kAuto, false);
  std::vector<int> columns;
  for (int k = 0; k < table.width(); ++k) {
    const std::string name = table.names().empty() ? "" : table.names()[to_index(k)];
    if (name == kPart) {
      choice->labels = table.texts(k);
      continue;
    }
    columns.push_back(k);
    choice->parameters.push_back(
        listed_parameter(name, {source.name, table.first_line()}, at.path(), study));
  }
  const NumberTable::Columns cells = table.read(columns);
  for (std::size_t row = 0; row < cells.lines.size(); ++row) {
    std::vector<double>& numbers = choice->rows.emplace_back();
    for (const std::vector<double>& column : cells.values) {
      if (!std::isfinite(column[row]))
        throw InputError({{source.name, static_cast<int>(cells.lines[row])},
                          at.path(),
                          "not a finite number",
                          to_decimal(column[row]),
                          "numbers"});
      numbers.push_back(column[row]);
    }
  }
}

/// The row that lies nearest to the values of the parameters, in units of its columns' ranges.
std::size_t nearest_row(const ParameterChoice& choice, const Study& study) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < choice.rows.size(); ++k) {
    double away = 0.0;
    for (std::size_t c = 0; c < choice.parameters.size(); ++c) {
      const Parameter& parameter = study.parameters[to_index(choice.parameters[c])];
      const double range = parameter.upper - parameter.lower;
      if (range > 0.0) away += std::pow((choice.rows[k][c] - parameter.value) / range, 2);
    }
    if (away < least) nearest = k, least = away;
  }
  return nearest;
}

/// Sets bounds and start of the parameters, and tunes them.
void take(const YamlValue& value, ParameterChoice choice, bool is_start_given, Study* study) {
  for (std::size_t c = 0; c < choice.parameters.size(); ++c) {
    Parameter& parameter = study->parameters[to_index(choice.parameters[c])];
    const auto by_column = [c](const std::vector<double>& a, const std::vector<double>& b) {
      return a[c] < b[c];
    };
    const auto [least, largest] =
        std::minmax_element(choice.rows.begin(), choice.rows.end(), by_column);
    parameter.lower = (*least)[c];
    parameter.upper = (*largest)[c];
    if (std::find(study->tuned.begin(), study->tuned.end(), choice.parameters[c]) !=
        study->tuned.end())
      value.fail("the parameter " + parameter.name + " is tuned twice",
                 "each parameter in one list, or tuned by itself");
    study->tuned.push_back(choice.parameters[c]);
  }
  const std::size_t start = nearest_row(choice, *study);
  for (std::size_t c = 0; c < choice.parameters.size(); ++c) {
    Parameter& parameter = study->parameters[to_index(choice.parameters[c])];
    if (is_start_given && parameter.value != choice.rows[start][c])
      value.at("initial").fail("the start is none of those to choose from", list_rows(choice));
    parameter.value = choice.rows[start][c];
  }
  study->choices.push_back(std::move(choice));
}

ParameterChoice begin(const std::string& name, const YamlValue& value, const char* key) {
  ParameterChoice choice;
  choice.name = name;
  choice.where = value.where();
  choice.element = value.at(key).path();
  return choice;
}

}  // namespace

bool is_catalogue(const YamlValue& value) {
  if (!value.is_map()) return false;
  const auto choice = value.find("choice");
  if (!choice) return false;
  if (choice->is_scalar()) return true;
  return choice->is_list() && !choice->items().empty() && choice->items().front().is_map();
}

void read_catalogue(const std::string& name, const YamlValue& value, const FileLoader& files,
                    Study* study) {
  value.require_keys({"choice"}, {"tune"});
  for (const Parameter& parameter : study->parameters)
    if (parameter.name == name)
      value.fail("a list of several numbers has a name of its own, and this is a parameter", name);
  ParameterChoice choice = begin(name, value, "choice");
  const YamlValue at = value.at("choice");
  if (at.is_scalar())
    read_part_table(at, *study, files, &choice);
  else
    read_listed_rows(at.items(), *study, &choice);
  require_rows(at, choice);
  const auto tune = value.find("tune");
  if (!tune || tune->boolean()) take(value, std::move(choice), false, study);
}

void read_choice(const std::string& name, const YamlValue& value, int index, Study* study) {
  for (const char* key : {"lower", "upper"})
    if (const auto bound = value.find(key))
      bound->fail("what is chosen from a list has the bounds of the list", "no lower and no upper");
  if (value.find("choice") && value.find("integer"))
    value.fail("a parameter is chosen from a list or is a whole number", "choice or integer");
  const char* const key = value.find("choice") ? "choice" : "integer";
  ParameterChoice choice = begin(name, value, key);
  choice.parameters = {index};
  if (value.find("integer"))
    read_whole_numbers(value.at(key), &choice);
  else
    for (const YamlValue& item : value.at(key).items()) choice.rows.push_back({item.number()});
  require_rows(value.at(key), choice);
  take(value, std::move(choice), value.find("initial").has_value(), study);
}

}  // namespace codesign
