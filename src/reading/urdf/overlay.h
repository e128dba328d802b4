// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reading/xml/xml_document.h"

namespace codesign {

/// Merges an overlay into `base`: its elements are merged with the elements of the same tag and name. New loops, couplings, parameters and
/// spring-dampers are added, also new joints with a type and new links that a joint names. Within an element, a `codesign:` child replaces
/// the child with the same tag and name; the attributes of a plain child replace the attributes of the first such child.
/// @throws InputError naming the overlay's file and line.
void merge_overlay(const XmlDocument& overlay, XmlDocument* base);

}  // namespace codesign
