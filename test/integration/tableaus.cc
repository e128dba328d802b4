// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/tableaus.h"

namespace codesign {

const RosenbrockTableau& rodas3() {
  static const RosenbrockTableau tableau{"rodas3",
                                         4,
                                         3,
                                         0.5,
                                         {{{}, {}, {2.0}, {2.0, 0.0, 1.0}}},
                                         {{{}, {4.0}, {1.0, -1.0}, {1.0, -1.0, -8.0 / 3.0}}},
                                         {2.0, 0.0, 1.0, 1.0},
                                         {0.0, 0.0, 1.0, 1.0},
                                         {0.5, 1.5},
                                         1,
                                         {{{3.0, -1.0}}}};
  return tableau;
}

std::vector<const RosenbrockTableau*> all_tableaus() {
  return {&rodas4(), &rodas4p2(), &rodas5p(), &dopri5(), &rodas3()};
}

std::string tableau_name(const ::testing::TestParamInfo<const RosenbrockTableau*>& instance) {
  return instance.param->name;
}

}  // namespace codesign
