// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <idas/idas.h>

#include "integration/idas_handles.h"
#include "integration/idas_integrator.h"
#include "integration/servo.h"

namespace codesign {
namespace {

TEST(SundialsCompatibility, KeepsTheLatestMessageAndWritesNothingToStderr) {
  const ContextHandle context = make_context();
  const IdaHandle ida(IDACreate(context.get()));
  ASSERT_TRUE(ida);
  std::string message;
  ASSERT_EQ(keep_last_message(ida.get(), context.get(), &message), kSundialsSuccess);
  testing::internal::CaptureStderr();
  EXPECT_LT(IDASetMaxOrd(ida.get(), -1), 0);
  EXPECT_NE(message.find("maxord"), std::string::npos) << message;
  EXPECT_LT(IDASStolerances(ida.get(), 1e-6, 1e-7), 0) << "before IDAInit";
  EXPECT_EQ(message.find("maxord"), std::string::npos) << message;
  EXPECT_FALSE(message.empty());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(IdasCounts, StepsAddUpOverRestarts) {
  const auto system =
      servo("{integrator: idas, relative_tolerance: 1.0e-6, absolute_tolerance: 1.0e-7}");
  IdasIntegrator integrator(*system);
  ASSERT_TRUE(integrator.start(system->parameters()).ok());
  int steps = 0;
  for (; steps < 5; ++steps) ASSERT_TRUE(integrator.advance(0.6).ok());
  EXPECT_EQ(integrator.statistics().steps, 5);
  ASSERT_TRUE(integrator.go_on(integrator.state().t, system->parameters()).ok());
  for (; steps < 9; ++steps) ASSERT_TRUE(integrator.advance(0.6).ok());
  EXPECT_EQ(integrator.statistics().steps, 9);
}

StatusCode code_of(int flag, bool singular = false) {
  return idas_status(flag, 0.5, singular, "").code;
}

TEST(IdasStatus, SuccessInEveryForm) {
  EXPECT_TRUE(idas_status(IDA_SUCCESS, 0.5, false, "").ok());
  EXPECT_TRUE(idas_status(IDA_TSTOP_RETURN, 0.5, true, "old message").ok());
}

TEST(IdasStatus, EveryFailureHasACode) {
  EXPECT_EQ(code_of(IDA_ERR_FAIL), StatusCode::kStepSizeTooSmall);
  EXPECT_EQ(code_of(IDA_CONV_FAIL), StatusCode::kStepSizeTooSmall);
  EXPECT_EQ(code_of(IDA_TOO_MUCH_ACC), StatusCode::kStepSizeTooSmall);
  EXPECT_EQ(code_of(IDA_CONV_FAIL, true), StatusCode::kSingularMatrix);
  EXPECT_EQ(code_of(IDA_LSETUP_FAIL), StatusCode::kSingularMatrix);
  EXPECT_EQ(code_of(IDA_REP_RES_ERR), StatusCode::kNonFinite);
  EXPECT_EQ(code_of(IDA_SRES_FAIL), StatusCode::kNonFinite);
  EXPECT_EQ(code_of(IDA_REP_QRHS_ERR), StatusCode::kNonFinite);
  EXPECT_EQ(code_of(IDA_TOO_MUCH_WORK), StatusCode::kTooManySteps);
}

TEST(IdasStatus, SaysWhenAndWhy) {
  const Status status = idas_status(IDA_ERR_FAIL, 0.5, false, "the error test failed repeatedly");
  EXPECT_EQ(status.time, 0.5);
  EXPECT_NE(status.cause.find("IDAS: the error test failed repeatedly"), std::string::npos);
}

}  // namespace

}  // namespace codesign
