// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/trajectory_points.h"
#include "recordings/bag_reader.h"

namespace codesign {

BagReader linked_bag_reader() { return {}; }

TrajectoryBagWriter linked_trajectory_writer() { return {}; }

}  // namespace codesign
