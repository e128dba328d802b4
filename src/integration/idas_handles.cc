// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_handles.h"

#include <idas/idas.h>

#include "text/number_text.h"

namespace codesign {
namespace {

StatusCode code_of(int flag, bool singular) {
  switch (flag) {
    case IDA_LSETUP_FAIL:
    case IDA_LSOLVE_FAIL:
      return StatusCode::kSingularMatrix;
    case IDA_RES_FAIL:
    case IDA_REP_RES_ERR:
    case IDA_FIRST_RES_FAIL:
    case IDA_QRHS_FAIL:
    case IDA_FIRST_QRHS_ERR:
    case IDA_REP_QRHS_ERR:
    case IDA_SRES_FAIL:
    case IDA_REP_SRES_ERR:
    case IDA_QSRHS_FAIL:
    case IDA_FIRST_QSRHS_ERR:
    case IDA_REP_QSRHS_ERR:
      return StatusCode::kNonFinite;
    case IDA_TOO_MUCH_WORK:
      return StatusCode::kTooManySteps;
    default:
      return singular ? StatusCode::kSingularMatrix : StatusCode::kStepSizeTooSmall;
  }
}

const char* sentence_of(StatusCode code) {
  switch (code) {
    case StatusCode::kSingularMatrix:
      return "the equations of motion become singular: a dead point or lock-up";
    case StatusCode::kNonFinite:
      return "the equations of motion are not finite";
    case StatusCode::kTooManySteps:
      return "too many steps";
    default:
      return "no smaller step succeeds: the motion is not resolvable";
  }
}

}  // namespace

IdasCounts count_idas(void* ida, bool with_sensitivities) {
  long steps = 0, test_failures = 0, solve_failures = 0, sensitivity_failures = 0,
       sensitivity_solve_failures = 0;
  IDAGetNumSteps(ida, &steps);
  IDAGetNumErrTestFails(ida, &test_failures);
  IDAGetNumStepSolveFails(ida, &solve_failures);
  if (with_sensitivities) {
    IDAGetSensNumErrTestFails(ida, &sensitivity_failures);
    IDAGetNumStepSensSolveFails(ida, &sensitivity_solve_failures);
  }
  return {steps,
          test_failures + solve_failures + sensitivity_failures + sensitivity_solve_failures};
}

Status idas_status(int flag, double time, bool singular, const std::string& message) {
  if (flag >= 0) return {};
  const StatusCode code = code_of(flag, singular);
  return {code, time,
          sentence_of(code) + (message.empty() ? std::string() : " (IDAS: " + message + ")")};
}

Warning sensitivities_restarted(double time, double drift) {
  return {"sensitivities_restarted",
          "at t = " + to_decimal(time) +
              " s the steps of idas had drifted off the constraints by " + to_decimal(drift) +
              " tolerances, as happens near a singular position: idas was restarted there, and the "
              "gradient may be wrong in its first "
              "digits; compare it with solver.integrator: rosenbrock",
          {}};
}

}  // namespace codesign
