// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/number_table.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <utility>

#include "math/arrays.h"
#include "text/nearest_name.h"

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
  return cell.size() >= 2 && cell.front() == '"' && cell.back() == '"'
             ? cell.substr(1, cell.size() - 2)
             : cell;
}

/// Whether the whole text is a number; a value too small for a double is zero.
bool parse(std::string_view text, double* value) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, *value);
  if (result.ptr != end || text.empty()) return false;
  if (result.ec == std::errc::result_out_of_range)
    *value = text.find("e-") != text.npos || text.find("E-") != text.npos ? 0.0 : HUGE_VAL;
  return true;
}

/// The lines of a text one after the other, without their ends.
class Lines {
 public:
  Lines(std::string_view text, std::size_t from, int number)
      : text_(text), next_(from), number_(number - 1) {}
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
  return std::all_of(cells.begin(), cells.end(),
                     [&value](std::string_view cell) { return parse(unquoted(cell), &value); });
}

std::vector<std::string> names_in(const std::vector<std::string_view>& cells) {
  std::vector<std::string> names;
  for (const std::string_view cell : cells) names.emplace_back(unquoted(cell));
  return names;
}

std::string text_of_file(const RecordingDescription& description, const std::string& path,
                         const std::string& option) {
  constexpr std::streamoff kMostBytes = std::streamoff{2} << 30;
  const auto fail = [&](const std::string& message, const std::string& allowed) {
    throw InputError({description.where, option.empty() ? description.element + ".csv" : option,
                      message, path, allowed});
  };
  errno = 0;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file)
    fail(std::string("the file cannot be read: ") + std::strerror(errno),
         option.empty() ? "a path, relative to the folder of the study" : "the path of a table");
  const std::streamoff size = file.tellg();
  if (size < 0 || size > kMostBytes)
    fail("no file, or one that is too large", "a file of at most 2 GB");
  std::string text(to_index(size), '\0');
  file.seekg(0);
  if (!file.read(text.data(), size))
    fail(std::string("the file cannot be read: ") + std::strerror(errno), "");
  return text;
}

/// A column that was found by its name in the table.
ColumnDescription named(const std::string& name, const RecordingDescription& description) {
  ColumnDescription column;
  column.name = name;
  column.where = description.where;
  column.element = description.element;
  return column;
}

/// `description` with the columns that have the names of signals.
RecordingDescription with_found_columns(RecordingDescription description, const NumberTable& table,
                                        const std::vector<std::string>& joints) {
  const auto has = [&table](const std::string& name) {
    return std::find(table.names().begin(), table.names().end(), name) != table.names().end();
  };
  for (const char* name : {"t", "time"})
    if (has(name)) description.time = named(name, description);
  for (const std::string& joint : joints)
    for (std::size_t k = 0; k < kMeasuredQuantityNames.size(); ++k) {
      const std::string name = joint + "/" + kMeasuredQuantityNames[k];
      if (has(name))
        description.columns.push_back(
            {joint, static_cast<MeasuredQuantity>(k), named(name, description)});
    }
  if (!description.time || description.columns.empty())
    throw InputError(
        {description.where, description.element,
         std::string("the table has no column named ") +
             (description.time
                  ? "JOINT/position, JOINT/velocity or JOINT/effort with a joint of the model"
                  : "time or t") +
             ", but " + (table.names().empty() ? "no names at all" : list_names(table.names())) +
             ": " + table.file(),
         "", "columns: {time: COLUMN, JOINT/position: COLUMN, ...}"});
  return description;
}

std::vector<double> scaled(std::vector<double> values, const ColumnDescription& column) {
  if (column.scale != 1.0 || column.offset != 0.0)
    for (double& value : values) value = column.scale * value + column.offset;
  return values;
}

JointSamples& samples_of(const std::string& joint, std::vector<JointSamples>* joints) {
  for (JointSamples& samples : *joints)
    if (samples.joint == joint) return samples;
  joints->push_back({joint, {}, {}, {}});
  return joints->back();
}

}  // namespace

NumberTable::NumberTable(std::string file, std::string text, CellDelimiter delimiter, bool has_key)
    : file_(std::move(file)), text_(std::move(text)), has_key_(has_key) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text_.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0)
    text_.erase(0, kByteOrderMark.size());
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

template <class Visit>
void NumberTable::for_each_row(const Visit& visit) const {
  Lines lines(text_, body_, body_line_);
  Cells cells;
  for (std::string_view line; lines.next(&line);) {
    const std::string_view row = trimmed(line);
    if (row.empty() || row.front() == '#') continue;
    split(line, &cells);
    const auto number = to_index(lines.number());
    if (static_cast<int>(cells.size()) != width_)
      fail(number, "",
           "a row of " + std::to_string(cells.size()) + " cells, where the first has " +
               std::to_string(width_),
           "",
           std::string("rows of equal length") +
               (has_key_ ? "; `delimiter` gives the separator of the cells"
                         : ", whose cells are separated by what the first row has"));
    visit(cells, number);
  }
}

NumberTable::Columns NumberTable::read(const std::vector<int>& indices) const {
  Columns columns;
  columns.values.resize(indices.size());
  const auto rows = to_index(std::count(text_.begin(), text_.end(), '\n') + 1);
  for (std::vector<double>& column : columns.values) column.reserve(rows);
  columns.lines.reserve(rows);
  for_each_row([&](const Cells& cells, std::size_t line) {
    for (std::size_t k = 0; k < indices.size(); ++k) {
      const auto column = to_index(indices[k]);
      columns.values[k].push_back(read_cell(cells[column], line, column));
    }
    columns.lines.push_back(line);
  });
  return columns;
}

std::vector<std::string> NumberTable::texts(int index) const {
  std::vector<std::string> column;
  for_each_row([&](const Cells& cells, std::size_t) {
    column.emplace_back(unquoted(cells[to_index(index)]));
  });
  return column;
}

double NumberTable::read_cell(std::string_view cell, std::size_t number, std::size_t column) const {
  double value = 0.0;
  const std::string_view text = unquoted(cell);
  if (parse(text, &value)) return value;
  const std::string name = column < names_.size() ? "column \"" + names_[column] + "\""
                                                  : "column " + std::to_string(column + 1);
  if (text.empty()) fail(number, name, "the cell is empty", "", "a finite number in each row");
  if (text.find(',') != std::string_view::npos)
    fail(number, name, "not a number", text, "a decimal point, no comma");
  fail(number, name, "not a number", text, "a number in each row");
}

void NumberTable::fail(std::size_t line, const std::string& element, const std::string& message,
                       std::string_view value, const std::string& allowed) const {
  throw InputError(
      {{file_, static_cast<int>(line)}, element, message, std::string(value), allowed});
}

int index_of(const ColumnDescription& column, const NumberTable& table) {
  if (column.number > 0) {
    if (column.number > table.width())
      throw InputError(
          {column.where, column.element,
           "the table has " + std::to_string(table.width()) + " columns: " + table.file(),
           std::to_string(column.number), "from 1 to " + std::to_string(table.width())});
    return column.number - 1;
  }
  const std::vector<std::string>& names = table.names();
  if (names.empty())
    throw InputError({column.where, column.element,
                      "the columns of the table have no names: " + table.file(), column.name,
                      "a number from 1 to " + std::to_string(table.width())});
  const auto found = std::find(names.begin(), names.end(), column.name);
  if (found == names.end())
    throw unknown_name(column.where, column.element, "column of " + table.file(), column.name,
                       names);
  if (std::find(found + 1, names.end(), column.name) != names.end())
    throw InputError({column.where, column.element,
                      "several columns have this name: " + table.file(), column.name,
                      "the number of the column, from 1 to " + std::to_string(table.width())});
  return static_cast<int>(found - names.begin());
}

JointRecording read_table_recording(const RecordingDescription& description,
                                    const std::string& path, const std::vector<std::string>& joints,
                                    const std::string& option) {
  const NumberTable table(path, text_of_file(description, path, option), description.delimiter);
  const RecordingDescription found =
      description.time ? description : with_found_columns(description, table, joints);
  std::vector<int> indices = {index_of(*found.time, table)};
  for (const MeasuredColumn& measured : found.columns)
    indices.push_back(index_of(measured.column, table));
  for (const SignalColumn& signal : found.signals)
    indices.push_back(index_of(signal.column, table));
  NumberTable::Columns columns = table.read(indices);
  JointRecording recording;
  recording.file = path;
  recording.element = description.element;
  recording.where = description.where;
  recording.places = std::move(columns.lines);
  recording.times = scaled(std::move(columns.values[0]), *found.time);
  for (std::size_t k = 0; k < found.columns.size(); ++k) {
    const MeasuredColumn& measured = found.columns[k];
    samples_of(measured.joint, &recording.joints).of(measured.quantity) =
        scaled(std::move(columns.values[k + 1]), measured.column);
  }
  for (std::size_t k = 0; k < found.signals.size(); ++k)
    recording.signals.push_back(
        {found.signals[k].signal,
         scaled(std::move(columns.values[1 + found.columns.size() + k]), found.signals[k].column)});
  return recording;
}

}  // namespace codesign
