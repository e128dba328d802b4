// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_ensemble.h"

#include "reading/study/study_fields.h"
#include "reading/study/study_multistart.h"
#include "reading/study/study_robust.h"
#include "reading/study/study_uncertain.h"

namespace codesign {
namespace {

EngineOptions read_engine(const YamlValue& engine) {
  constexpr int kMostWorkers = 4096;
  engine.require_keys({}, {"type", "workers"});
  EngineOptions options;
  read_choice(engine, "type", kEngineNames, &options.kind);
  const auto type = engine.find("type"), workers = engine.find("workers");
  if (type || workers) options.where = (type ? type : workers)->where();
  if (workers && options.kind == EngineKind::kSerial) workers->fail("the engine serial has no workers", "type: threads");
  if (workers && options.kind == EngineKind::kMpi) workers->fail("mpirun says how many workers the engine mpi has", "mpirun -n NUMBER");
  read_whole(engine, "workers", 1, kMostWorkers, &options.workers);
  return options;
}

}  // namespace

EnsembleDescription read_ensemble(const YamlValue& study_value, const RobotDescription& robot, const RunReader& read_run,
                                  const FileLoader& files, const Study& study) {
  EnsembleDescription ensemble;
  const auto runs = study_value.find("runs"), uncertain = study_value.find("uncertain"), robust = study_value.find("robust");
  if (runs) ensemble.runs = read_runs(study_value, study, read_run);
  if (uncertain) ensemble.uncertain = read_uncertain(*uncertain, robot, study, ensemble.runs, files);
  if (robust)
    ensemble.robust = read_robust(*robust, ensemble);
  else if (ensemble.is_ensemble())
    ensemble.robust = default_robust(ensemble, uncertain ? uncertain->where() : runs->where());
  if (study_value.find("multistart")) ensemble.multistart = read_multistart(study_value, study);
  if (const auto engine = study_value.find("engine")) ensemble.engine = read_engine(*engine);
  return ensemble;
}

}  // namespace codesign
