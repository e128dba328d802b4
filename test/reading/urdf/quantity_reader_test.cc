// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/quantity_reader.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

class QuantityReader : public ::testing::Test {
 protected:
  XmlDocument document_{
      {"a.urdf", R"(<robot zero="0" minus="-1" a="0.5" codesign:a="${p}" xyz="0 0 0"><x><origin xyz="1 2 3"/></x><y/></robot>)"}};
  XmlElement robot_{document_.robot(), &document_};
  ParameterTable table_{{Parameter{"p", 0.5, 0.0, 1.0, "", {}}}};
};

TEST_F(QuantityReader, RangesAreChecked) {
  EXPECT_EQ(read_quantity(robot_, "minus", Range::kAny, table_).nominal(), -1.0);
  EXPECT_EQ(read_quantity(robot_, "zero", Range::kNonNegative, table_).nominal(), 0.0);
  EXPECT_THROW(read_quantity(robot_, "minus", Range::kNonNegative, table_), InputError);
  EXPECT_THROW(read_quantity(robot_, "zero", Range::kPositive, table_), InputError);
}

TEST_F(QuantityReader, FallbacksStandInForWhatIsMissing) {
  EXPECT_EQ(read_quantity_or(7.0, robot_, "none", Range::kPositive, table_).nominal(), 7.0);
  EXPECT_EQ(read_quantity_or(7.0, robot_, "a", Range::kPositive, table_).at(std::vector<double>{0.6}), 0.6);
  EXPECT_EQ(read_number_or(7.0, robot_, "none", Range::kAny), 7.0);
  EXPECT_EQ(read_number_or(7.0, robot_, "minus", Range::kAny), -1.0);
  EXPECT_THROW(read_number(robot_, "none", Range::kAny), InputError);
  EXPECT_THROW(read_number(robot_, "a", Range::kAny), InputError) << "it names a parameter";
}

TEST_F(QuantityReader, OriginsAndAxes) {
  EXPECT_EQ(read_origin(robot_.only("x"), table_).xyz[2].nominal(), 3.0);
  EXPECT_EQ(read_origin(robot_.only("y"), table_).xyz[2].nominal(), 0.0);
  EXPECT_THROW(read_axis(robot_, table_), InputError);
  EXPECT_EQ(read_axis(robot_.only("x").only("origin"), table_)[0].nominal(), 1.0);
}

}  // namespace
}  // namespace codesign
