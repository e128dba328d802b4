// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/error.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

std::string text(const InputFault& fault) { return InputError(fault).what(); }

TEST(InputError, NamesFileLineElementValueAndAllowed) {
  EXPECT_EQ(text({{"a.urdf", 7}, "<mass>", "the mass is negative", "-1", "> 0"}),
            "a.urdf:7: <mass>: the mass is negative (value: -1, allowed: > 0)");
}

TEST(InputError, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(text({{"a.urdf", 0}, "", "the file cannot be read", "", ""}), "a.urdf: the file cannot be read");
  EXPECT_EQ(text({{"", 0}, "duration", "missing", "", ""}), "duration: missing");
  EXPECT_EQ(text({{"a", 1}, "b", "c", "d", ""}), "a:1: b: c (value: d)");
  EXPECT_EQ(text({{"a", 1}, "b", "c", "", "e"}), "a:1: b: c (allowed: e)");
}

TEST(InputError, KeepsTheParts) {
  const InputError error({{"a.urdf", 7}, "<mass>", "m", "-1", "> 0"});
  EXPECT_EQ(error.fault().where.line, 7);
  EXPECT_EQ(error.fault().value, "-1");
}

}  // namespace
}  // namespace codesign
