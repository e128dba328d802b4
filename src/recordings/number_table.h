// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "description/identification.h"
#include "mechanism_codesign/error.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// A table of numbers as text: one row per line, all rows with the same number of cells.
///
/// Lines that are empty or begin with `#` are skipped. The first row has the names of the columns,
/// unless all its cells are numbers. In that case, a comment directly above it with as many cells
/// has the names, as numpy writes them. Names may be quoted.
class NumberTable {
 public:
  /// @param file for messages. @param has_key whether a key `delimiter` of the study chooses the
  /// separator, for messages. @throws InputError if there is no row.
  NumberTable(std::string file, std::string text, CellDelimiter delimiter, bool has_key = true);

  /// Names of the columns; empty if the table has none.
  const std::vector<std::string>& names() const { return names_; }
  /// Number of columns.
  int width() const { return width_; }
  const std::string& file() const { return file_; }
  /// The line of the names or, without names, of the first row.
  int first_line() const { return first_line_; }

  /// The numbers of some columns.
  struct Columns {
    std::vector<std::vector<double>> values;  ///< one per requested column, with one number per row
    std::vector<std::size_t> lines;           ///< line number of each row, from 1
  };
  /// Reads some columns; the others may hold any text. `nan` and `inf` are numbers here. @param
  /// indices from 0 to width() - 1.
  /// @throws InputError with the line for a row with more or fewer cells and a cell that is not a
  /// number.
  Columns read(const std::vector<int>& indices) const;
  /// The cells of a column as text, one per row. @throws InputError as read()
  std::vector<std::string> texts(int index) const;

 private:
  using Cells = std::vector<std::string_view>;
  /// Calls visit(cells, line) for each row. @throws InputError for one of another width.
  template <class Visit>
  void for_each_row(const Visit& visit) const;
  void split(std::string_view line, Cells* cells) const;
  double read_cell(std::string_view cell, std::size_t number, std::size_t column) const;
  [[noreturn]] void fail(std::size_t line, const std::string& element, const std::string& message,
                         std::string_view value, const std::string& allowed) const;

  std::string file_, text_;
  bool has_key_;
  char delimiter_ = ',';  ///< a blank stands for any white space
  std::vector<std::string> names_;
  int width_ = 0;
  std::size_t body_ = 0;  ///< index in the text at which the rows begin
  int body_line_ = 1;     ///< the line at which the rows begin
  int first_line_ = 1;
};

/// The index of a column that a study names. @throws InputError if there is none, or several
int index_of(const ColumnDescription& column, const NumberTable& table);

/// Reads a table of numbers without checking their values. Without `columns` in the description,
/// the columns named `time` (or `t`) and `JOINT/position`, `JOINT/velocity`, `JOINT/effort` are
/// read.
/// @param path of the file, at most 2 GB. @param joints known names of joints. @param option of the
/// command line that names the file; empty: an entry of the study does
/// @throws InputError for a file that cannot be read, a missing column, or a cell that is not a
/// number.
JointRecording read_table_recording(const RecordingDescription& description,
                                    const std::string& path, const std::vector<std::string>& joints,
                                    const std::string& option = "");

}  // namespace codesign
