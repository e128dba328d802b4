// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/identification_files.h"

#include <sstream>
#include <utility>

#include "jobs/csv_writer.h"
#include "jobs/identification_records.h"
#include "jobs/identified_overlay.h"
#include "problem/load_problem.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

std::string residuals_text(const IdentificationResult& result) {
  std::ostringstream text;
  CsvWriter csv(text, residual_columns(result), "residuals.csv");
  for (const std::vector<std::string>& row : residual_rows(result)) csv.write(row);
  return text.str();
}

std::string identified_urdf(const Problem& problem, const IdentificationResult& result) {
  return write_tuned_urdf(problem.urdf(), problem.overlays(), result.parameters, std::nullopt, problem.robot().laws);
}

}  // namespace

std::vector<IdentificationFile> identification_files(const Problem& problem, const IdentificationResult& result, const std::string& json) {
  return {{"identification.json", [&json] { return json; }},
          {"identified_overlay.urdf", [&problem, &result] { return identified_overlay(problem, result); }},
          {"identified.urdf", [&problem, &result] { return identified_urdf(problem, result); }},
          {"residuals.csv", [&result] { return residuals_text(result); }},
          {"job_study.yaml", [&problem] { return problem.study_text().text; }}};
}

IdentificationShow identification_show(const Problem& problem, const IdentificationResult& result, const std::string& json,
                                       ComparedMotion motion) {
  IdentificationShow show{problem.study_text().text, json, identified_urdf(problem, result), std::move(motion), result.data_series,
                          result.holdout_series,     {}};
  for (const OutputFit& fit : result.data) show.joints.push_back(fit.joint);
  return show;
}

}  // namespace codesign
