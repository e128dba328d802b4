// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/number_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace codesign {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view unquoted(std::string_view text) {
  const std::string_view cell = trimmed(text);
  return cell.size() >= 2 && cell.front() == '"' && cell.back() == '"' ? cell.substr(1, cell.size() - 2) : cell;
}

/// Whether the whole text is a number; a value too small for a double is zero.
bool parse(std::string_view text, double* value) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, *value);
  if (result.ptr != end || text.empty()) return false;
  if (result.ec == std::errc::result_out_of_range) *value = text.find("e-") != text.npos || text.find("E-") != text.npos ? 0.0 : HUGE_VAL;
  return true;
}

/// The lines of a text one after the other, without their ends.
class Lines {
 public:
  Lines(std::string_view text, std::size_t from, int number) : text_(text), next_(from), number_(number - 1) {}
  bool next(std::string_view* line) {
    if (next_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', next_), text_.size());
    *line = text_.substr(next_, end - next_);
    begin_ = next_;
    next_ = end + 1;
    ++number_;
    return true;
  }
  std::size_t begin() const { return begin_; }
  std::size_t end() const { return next_; }
  int number() const { return number_; }

 private:
  std::string_view text_;
  std::size_t begin_ = 0, next_;
  int number_;
};

char chosen_delimiter(CellDelimiter choice, std::string_view first_row) {
  if (choice == CellDelimiter::kComma) return ',';
  if (choice == CellDelimiter::kSemicolon) return ';';
  if (choice == CellDelimiter::kTab) return '\t';
  if (choice == CellDelimiter::kSpace) return ' ';
  for (const char candidate : {'\t', ';', ','})
    if (first_row.find(candidate) != std::string_view::npos) return candidate;
  return ' ';
}

bool all_numbers(const std::vector<std::string_view>& cells) {
  double value = 0.0;
  return std::all_of(cells.begin(), cells.end(), [&value](std::string_view cell) { return parse(unquoted(cell), &value); });
}

std::vector<std::string> names_in(const std::vector<std::string_view>& cells) {
  std::vector<std::string> names;
  for (const std::string_view cell : cells) names.emplace_back(unquoted(cell));
  return names;
}

}  // namespace

NumberTable::NumberTable(std::string file, std::string text, CellDelimiter delimiter) : file_(std::move(file)), text_(std::move(text)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text_.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0) text_.erase(0, kByteOrderMark.size());
  Lines lines(text_, 0, 1);
  std::string_view line, comment;
  while (lines.next(&line)) {
    const std::string_view row = trimmed(line);
    if (row.empty()) continue;
    if (row.front() == '#') {
      comment = trimmed(row.substr(1));
      continue;
    }
    delimiter_ = chosen_delimiter(delimiter, row);
    Cells cells, names;
    split(line, &cells);
    split(comment, &names);
    width_ = static_cast<int>(cells.size());
    first_line_ = lines.number();
    const bool is_header = !all_numbers(cells);
    body_ = is_header ? lines.end() : lines.begin();
    body_line_ = is_header ? lines.number() + 1 : lines.number();
    names_ = names_in(is_header ? cells : names);
    if (names_.size() != cells.size()) names_.clear();
    return;
  }
  fail(0, "", "the table has no row", "", "numbers, one row per time");
}

/// The cells of a line. A delimiter inside quotes separates nothing.
void NumberTable::split(std::string_view line, Cells* cells) const {
  cells->clear();
  const bool blanks = delimiter_ == ' ';
  if (blanks) line = trimmed(line);
  std::size_t begin = 0;
  if (!blanks && line.find('"') == line.npos) {
    for (std::size_t end = 0; (end = line.find(delimiter_, begin)) != line.npos; begin = end + 1)
      cells->push_back(line.substr(begin, end - begin));
    cells->push_back(line.substr(begin));
    return;
  }
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"') quoted = !quoted;
    const bool ends = !quoted && (line[k] == delimiter_ || (blanks && line[k] == '\t'));
    if (!ends) continue;
    if (!blanks || k > begin) cells->push_back(line.substr(begin, k - begin));
    begin = k + 1;
  }
  cells->push_back(line.substr(begin));
}

NumberTable::Columns NumberTable::read(const std::vector<int>& indices) const {
  Columns columns;
  columns.values.resize(indices.size());
  const auto rows = static_cast<std::size_t>(std::count(text_.begin(), text_.end(), '\n') + 1);
  for (std::vector<double>& column : columns.values) column.reserve(rows);
  columns.lines.reserve(rows);
  Lines lines(text_, body_, body_line_);
  Cells cells;
  for (std::string_view line; lines.next(&line);) {
    const std::string_view row = trimmed(line);
    if (row.empty() || row.front() == '#') continue;
    split(line, &cells);
    read_row(cells, static_cast<std::size_t>(lines.number()), indices, &columns);
  }
  return columns;
}

void NumberTable::read_row(const Cells& cells, std::size_t line, const std::vector<int>& indices, Columns* columns) const {
  if (static_cast<int>(cells.size()) != width_)
    fail(line, "", "a row of " + std::to_string(cells.size()) + " cells, where the first has " + std::to_string(width_), "",
         "rows of equal length; `delimiter` gives the separator of the cells");
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const auto column = static_cast<std::size_t>(indices[k]);
    columns->values[k].push_back(read_cell(cells[column], line, column));
  }
  columns->lines.push_back(line);
}

double NumberTable::read_cell(std::string_view cell, std::size_t number, std::size_t column) const {
  double value = 0.0;
  const std::string_view text = unquoted(cell);
  if (parse(text, &value)) return value;
  const std::string name = column < names_.size() ? "column \"" + names_[column] + "\"" : "column " + std::to_string(column + 1);
  if (text.empty()) fail(number, name, "the cell is empty", "", "a finite number in each row");
  if (text.find(',') != std::string_view::npos) fail(number, name, "not a number", text, "a decimal point, no comma");
  fail(number, name, "not a number", text, "a number in each row");
}

void NumberTable::fail(std::size_t line, const std::string& element, const std::string& message, std::string_view value,
                       const std::string& allowed) const {
  throw InputError({{file_, static_cast<int>(line)}, element, message, std::string(value), allowed});
}

}  // namespace codesign
