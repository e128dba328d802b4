// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reading/xml/xml_document.h"

namespace codesign {

/// Whether a list has a name.
bool contains(const std::vector<std::string>& names, const std::string& name);

/// Checks that `<robot>` declares `xmlns:codesign` if the file has names with that prefix. Called for each file before they are merged.
/// @throws InputError
void check_namespace(const XmlDocument& document);

/// Checks the `codesign:` elements and attributes: names, places, and that each twin has its plain attribute. Inside `<loop>`, `<coupling>`
/// and our own elements unknown names are errors too; other elements and attributes are ignored.
/// @throws InputError with the nearest name or the allowed places
void check_annotations(const XmlDocument& document);

}  // namespace codesign
