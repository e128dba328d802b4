// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_VOCABULARY_CHECK_H_
#define MECHANISM_CODESIGN_READING_URDF_VOCABULARY_CHECK_H_

#include "reading/xml/xml_document.h"

namespace codesign {

/// Names without our prefix. In a vendor's file those that no reader of URDF knows, and children of which readers take the first alone, are
/// warnings; in an overlay, where everything is meant for us, they are errors, as repeated elements of ours are anywhere.
/// @throws InputError with the nearest name.
void check_vocabulary(const XmlDocument& document, Warnings* warnings);

/// A prefix that is nearly ours (`codesing:`), or another prefix for our namespace. @throws InputError
void check_prefixes(const XmlDocument& document);

/// What stands beside `<robot>`: a second element, or text, which URDF's readers pass over.
Warnings check_surroundings(const XmlDocument& document);

/// Text between the elements of an overlay, where it would be lost. @throws InputError
void refuse_text(const XmlDocument& overlay);

/// Cuts text behind the last `</robot>`, which the XML parser would refuse and other readers of URDF do not look at. @returns a warning if
/// there was some.
Warnings cut_trailing_text(SourceText* source);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_VOCABULARY_CHECK_H_
