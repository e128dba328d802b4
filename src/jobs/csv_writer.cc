// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/csv_writer.h"

#include <cerrno>
#include <utility>

#include "jobs/files.h"
#include "text/number_text.h"

namespace codesign {
namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n\r") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

}  // namespace

CsvWriter::CsvWriter(std::ostream& out, const std::vector<std::string>& names, std::string where)
    : out_(out), where_(std::move(where)) {
  write(names);
}

void CsvWriter::write(const std::vector<std::string>& cells) {
  errno = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) out_ << (i == 0 ? "" : ",") << quoted(cells[i]);
  out_ << std::endl;
  if (!out_) throw OutputError::of_system(where_, errno);
}

void CsvWriter::write(const std::vector<double>& values) {
  std::vector<std::string> cells;
  cells.reserve(values.size());
  for (const double value : values) cells.push_back(to_decimal(value));
  write(cells);
}

}  // namespace codesign
