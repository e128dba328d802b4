// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace codesign {
namespace {

/// Characters, not bytes: text is UTF-8.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

std::string printed(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

}  // namespace

std::string to_text(const Table& table) {
  std::vector<std::size_t> width;
  for (const std::string& column : table.columns) width.push_back(width_of(column));
  for (const auto& row : table.rows)
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], width_of(row[k]));
  const auto line = [&width](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const std::string padding(width[k] - width_of(cells[k]), ' ');
      text += k == 0 ? cells[k] + padding : "  " + padding + cells[k];
    }
    return text.erase(text.find_last_not_of(' ') + 1) + "\n";
  };
  std::string text = "== " + table.title + "\n" + line(table.columns);
  for (const auto& row : table.rows) text += line(row);
  return text;
}

std::string to_markdown(const Table& table) {
  std::string text = "<!-- table: " + table.name + " -->\n" + markdown_row(table.columns) + "|";
  for (std::size_t k = 0; k < table.columns.size(); ++k) text += k == 0 ? "---|" : "---:|";
  text += "\n";
  for (const auto& row : table.rows) text += markdown_row(row);
  return text + "<!-- end: " + table.name + " -->\n";
}

std::string three_digits(double value) {
  if (std::isnan(value)) return "-";
  const double size = std::abs(value);
  if (size >= 100.0 && size < 1e5) return printed("%.0f", value);
  if (size >= 0.01 && size < 100.0)
    return printed(size < 0.1    ? "%.4f"
                   : size < 1.0  ? "%.3f"
                   : size < 10.0 ? "%.2f"
                                 : "%.1f",
                   value);
  return value == 0.0 ? "0" : printed("%.2e", value);
}

std::string one_digit(double value) { return std::isnan(value) ? "-" : printed("%.0e", value); }

}  // namespace codesign
