// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MODEL_OVERLAY_H_
#define MECHANISM_CODESIGN_MODEL_OVERLAY_H_

#include "xml_document.h"

namespace codesign {

/// Merges an overlay into `base`: links and joints by name (they must exist), loops, couplings, parameters and spring-dampers by name or
/// added. Inside, a `codesign:` child takes the place of its like; attributes of a plain child win over those of the first like child.
/// @throws InputError naming the overlay's file and line.
void merge_overlay(const XmlDocument& overlay, XmlDocument* base);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MODEL_OVERLAY_H_
