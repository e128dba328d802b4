// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/friction_law.h"

#include "codegen/traced.h"
#include "forces/brown_mcphee.h"
#include "forces/gonthier.h"
#include "forces/isotropic_friction.h"
#include "forces/lugre.h"

namespace codesign {

const FrictionLaw kBrownMcPheeLaw{
    "brown_mcphee", "Brown and McPhee", {brown_mcphee, brown_mcphee}, {friction_per_speed, friction_per_speed}, {}, false, true, false};
const FrictionLaw kGonthierLaw{"gonthier", "Gonthier", {}, {}, {gonthier, gonthier}, true, false, false};
const FrictionLaw kLuGreLaw{"lugre", "LuGre", {}, {}, {lugre, lugre}, false, false, true};

}  // namespace codesign
