// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mechanism_codesign/parameter.h"
#include "reading/xml/xml_element.h"

namespace codesign {

/// The `<codesign:parameter>` elements in file order. @throws InputError for invalid or repeated names and for values outside their bounds.
std::vector<Parameter> read_parameters(const XmlElement& robot);

}  // namespace codesign
