// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/series.h"

#include <utility>

#include "cli/inputs.h"
#include "jobs/files.h"
#include "jobs/job_files.h"

namespace codesign::cli {

SeriesOutput::SeriesOutput(const Arguments& arguments, const Problem& problem,
                           std::vector<std::string> names, const std::string& what,
                           const Console& console)
    : keeps_(arguments.json), names_(std::move(names)) {
  const std::string& path = arguments.csv;
  if (!path.empty()) {
    std::vector<std::string> inputs = input_files(problem);
    inputs.push_back(arguments.result);
    require_no_input(path, "--csv", what, inputs);
    open_output(path, "--csv", &file_);
    csv_.emplace(file_, names_, path);
  } else if (!arguments.json) {
    csv_.emplace(console.out, names_);
  }
}

void SeriesOutput::add(const std::vector<double>& row) {
  if (csv_) csv_->write(row);
  if (keeps_) rows_.push_back(row);
}

Json SeriesOutput::json() const {
  Json series = Json::object();
  for (std::size_t column = 0; column < names_.size(); ++column) {
    Json values = Json::array();
    for (const std::vector<double>& row : rows_) values.push_back(row[column]);
    series[names_[column]] = std::move(values);
  }
  return series;
}

}  // namespace codesign::cli
