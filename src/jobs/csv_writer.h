// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace codesign {

/// Comma-separated values (RFC 4180 quoting, Unix line ends). Numbers read back as the same
/// doubles.
class CsvWriter {
 public:
  /// Writes the header row. @param where name of the stream in messages. @throws OutputError
  CsvWriter(std::ostream& out, const std::vector<std::string>& names,
            std::string where = "standard output");

  /// Writes a row and flushes the stream, so that the row survives if the program is killed.
  /// @throws OutputError if writing fails.
  void write(const std::vector<std::string>& cells);
  void write(const std::vector<double>& values);

 private:
  std::ostream& out_;
  std::string where_;
};

}  // namespace codesign
