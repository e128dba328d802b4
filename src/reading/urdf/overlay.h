// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_OVERLAY_H_
#define MECHANISM_CODESIGN_READING_URDF_OVERLAY_H_

#include "reading/xml/xml_document.h"

namespace codesign {

/// Merges an overlay into `base` by name. Loops, couplings, parameters and spring-dampers that are not there are added, so is a joint that
/// says its type, and a link that a joint names. Inside, a `codesign:` child takes the place of its like; attributes of a plain child win
/// over those of the first like child.
/// @throws InputError naming the overlay's file and line.
void merge_overlay(const XmlDocument& overlay, XmlDocument* base);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_OVERLAY_H_
