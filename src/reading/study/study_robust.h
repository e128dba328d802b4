// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/ensemble.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads the map `robust:`.
/// @param ensemble with the runs and the uncertain quantities of the study. @throws InputError
RobustOptions read_robust(const YamlValue& robust, const EnsembleDescription& ensemble);

/// The default without `robust:`: the mean, over 32 samples if something is uncertain, else over the runs. @param where for messages.
RobustOptions default_robust(const EnsembleDescription& ensemble, const SourceLocation& where);

}  // namespace codesign
