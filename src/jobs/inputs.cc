// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/inputs.h"

namespace codesign {

Problem load(const Inputs& inputs, const TrajectoryLoader& loader) {
  if (inputs.study.name.empty()) return load_mechanism_at(inputs.design, inputs.urdf, inputs.overlays, inputs.settings);
  return load_problem_at(inputs.design, inputs.urdf, inputs.overlays, inputs.study, inputs.settings, loader,
                         inputs.study_is_tree ? files_in("") : FileLoader());
}

}  // namespace codesign
