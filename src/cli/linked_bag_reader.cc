// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/trajectory_points.h"
#include "jobs/identification_files.h"
#include "recordings/bag_reader.h"

namespace codesign {

BagReader linked_bag_reader() { return {}; }

IdentificationBagWriter linked_identification_bag() { return {}; }

TrajectoryBagWriter linked_trajectory_writer() { return {}; }

}  // namespace codesign
