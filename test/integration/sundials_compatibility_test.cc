// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/sundials_compatibility.h"

#include <gtest/gtest.h>

#include "integration/idas_handles.h"

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

}  // namespace
}  // namespace codesign
