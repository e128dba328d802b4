// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "jobs/bag_files.h"

/// The functions of libcodesign_bags.so, which loaded_bag_files.cc finds by this name. They stay valid until the program ends.
extern "C" const codesign::BagFiles* codesign_bag_files();
