// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/best_record.h"

#include <unistd.h>

#include "jobs/json.h"
#include "jobs/whole_file.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {

void BestRecord::note(const Trial& trial) {
  const bool better = trial.status.ok() && trial.iteration > iteration_;
  if (!better) return;
  if (iteration_ < 0) first_ = trial;
  iteration_ = trial.iteration;
  try {
    write_whole_file(prefix_ + "best.urdf", write_tuned_urdf(problem_.urdf(), problem_.overlays(), problem_.parameters(trial.rho),
                                                             std::nullopt, problem_.robot().laws));
    write_whole_file(prefix_ + "best.json", json(trial));
    failure_.clear();
  } catch (const std::exception& error) {
    failure_ = error.what();
  }
}

std::string BestRecord::json(const Trial& trial) const {
  Json object;
  object["model"] = problem_.robot().name;
  object["objective"] = trial.objective;
  object["initial_objective"] = first_.objective;
  object["parameters"] = parameters_json(problem_, problem_.parameters(trial.rho));
  object["initial_parameters"] = parameters_json(problem_, problem_.parameters(first_.rho));
  object["gradient"] = by_name(problem_.tuned_names(), trial.gradient);
  object["iterations"] = trial.iteration;
  object["evaluations"] = trial.evaluation;
  object["termination"] = "running";
  return to_text(object);
}

void BestRecord::remove() {
  for (const char* name : {"best.urdf", "best.json"}) unlink((prefix_ + name).c_str());
}

}  // namespace codesign
