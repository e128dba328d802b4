// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/read_context.h"

#include <algorithm>

#include "text/nearest_name.h"

namespace codesign {

int ReadContext::link(const XmlElement& element, const std::string& attribute) const {
  const std::string name = element.text(attribute);
  const auto found = std::find(links.begin(), links.end(), name);
  if (found == links.end()) throw unknown_name(element.where(attribute), element.label(), "link", name, links);
  return static_cast<int>(found - links.begin());
}

std::pair<int, int> ReadContext::ends(const XmlElement& element) const {
  const XmlElement successor = element.only("successor");
  const std::pair<int, int> result = {link(element.only("predecessor"), "link"), link(successor, "link")};
  if (result.first == result.second) successor.fail_at("link", "predecessor and successor are the same link", "two links");
  return result;
}

}  // namespace codesign
