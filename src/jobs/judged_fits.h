// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identification/comparison/model_comparison.h"
#include "jobs/json.h"
#include "mechanism_codesign/source_text.h"

namespace codesign {

/// The model that an identification.json judges, fitted or as it stood.
/// @throws InputError naming the file and what it lacks
JudgedModel read_judged_model(const SourceText& json);

/// The comparison of two identification.json as JSON: `inflation`, `criterion`, `nested` with
/// `statistic`, `degrees` and `probability`, `refusal` in place of them, and by set and output the
/// root mean squares and shares of both. @throws as read_judged_model()
Json comparison_json(const SourceText& other, const SourceText& here);

/// The same for people, one sentence per line. @param comparison comparison_json()
std::vector<std::string> comparison_sentences(const Json& comparison);

}  // namespace codesign
