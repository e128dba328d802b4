// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_counts.h"

#include <idas/idas.h>

namespace codesign {

IdasCounts count_idas(void* ida, bool with_sensitivities) {
  long steps = 0, test_failures = 0, solve_failures = 0, sensitivity_failures = 0, sensitivity_solve_failures = 0;
  IDAGetNumSteps(ida, &steps);
  IDAGetNumErrTestFails(ida, &test_failures);
  IDAGetNumStepSolveFails(ida, &solve_failures);
  if (with_sensitivities) {
    IDAGetSensNumErrTestFails(ida, &sensitivity_failures);
    IDAGetNumStepSensSolveFails(ida, &sensitivity_solve_failures);
  }
  return {steps, test_failures + solve_failures + sensitivity_failures + sensitivity_solve_failures};
}

}  // namespace codesign
