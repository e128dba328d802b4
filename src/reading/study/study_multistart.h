// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/study.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads `multistart:` of a study whose parameters have been read. Every tuned parameter needs finite bounds. @throws InputError
MultistartOptions read_multistart(const YamlValue& study_value, const Study& study);

}  // namespace codesign
