// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_status.h"

#include <gtest/gtest.h>
#include <idas/idas.h>

namespace codesign {
namespace {

StatusCode code_of(int flag, bool singular = false) { return idas_status(flag, 0.5, singular, "").code; }

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
