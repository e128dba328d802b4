// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reading/xml/xml_document.h"

namespace codesign {

/// Checks the names without our prefix and repeated elements. In a vendor's file, names that no reader of URDF knows and repeated elements,
/// of which readers use the first one, give warnings only. In an overlay they are errors; repeated annotations are errors anywhere.
/// @throws InputError with the nearest name.
void check_vocabulary(const XmlDocument& document, Warnings* warnings);

/// Checks for a misspelt prefix (`codesing:`) and for another prefix that is declared for our namespace. @throws InputError
void check_prefixes(const XmlDocument& document);

/// Warnings (`after_robot`) of elements and text after `<robot>`, which readers of URDF ignore.
Warnings check_surroundings(const XmlDocument& document);

/// Checks that an overlay has no text between its elements, since it would be lost. @throws InputError
void refuse_text(const XmlDocument& overlay);

/// Removes text after the last `</robot>`, which the XML parser would reject and other readers of URDF ignore. Returns a warning if there
/// was any.
Warnings cut_trailing_text(SourceText* source);

}  // namespace codesign
