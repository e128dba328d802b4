// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_reader.h"

#include "reading/urdf/annotated_urdf.h"

namespace codesign {

RobotDescription read_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays, const Laws& laws) {
  return read_robot(load_annotated_urdf(urdf, overlays, laws), laws);
}

}  // namespace codesign
