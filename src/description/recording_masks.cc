// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/recording_masks.h"

#include "mechanism_codesign/error.h"

namespace codesign {

void refuse_masks_in_motion(const RecordingDescription& recording, ResidualKind residual) {
  if (residual == ResidualKind::kEffort || recording.masks.empty()) return;
  throw InputError({recording.masks.front().where, recording.element + ".mask",
                    "residuals in motion simulate rest, too: no sample is left out", "",
                    "no mask, or residual: effort"});
}

}  // namespace codesign
