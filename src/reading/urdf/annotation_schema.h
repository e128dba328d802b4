// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_ANNOTATION_SCHEMA_H_
#define MECHANISM_CODESIGN_READING_URDF_ANNOTATION_SCHEMA_H_

#include "reading/xml/xml_document.h"

namespace codesign {

/// Refuses prefixed names in a file whose `<robot>` does not declare `xmlns:codesign`. Made before overlays are merged.
void check_namespace(const XmlDocument& document);

/// Refuses every `codesign:` element or attribute that is unknown or misplaced, twins without their plain attribute, and
/// anything unknown inside `<loop>`, `<coupling>` and our own elements. Elements and attributes of others are passed over.
void check_annotations(const XmlDocument& document);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_ANNOTATION_SCHEMA_H_
