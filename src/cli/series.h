// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/console.h"
#include "jobs/csv_writer.h"
#include "jobs/json.h"

namespace codesign::cli {

/// Where the rows of a run go: to the file of --csv, else to standard output, unless that is for
/// JSON; and into the `series` of the JSON object.
class SeriesOutput {
 public:
  /// Writes the names. @param what the table, for the message.
  /// @throws InputError if the table would replace a file that is read, or cannot be written.
  SeriesOutput(const Arguments& arguments, const Problem& problem, std::vector<std::string> names,
               const std::string& what, const Console& console);

  void add(const std::vector<double>& row);
  /// One list per name; empty lists unless JSON is asked for.
  Json json() const;

 private:
  const bool keeps_;
  const std::vector<std::string> names_;
  std::ofstream file_;
  std::optional<CsvWriter> csv_;
  std::vector<std::vector<double>> rows_;
};

}  // namespace codesign::cli
