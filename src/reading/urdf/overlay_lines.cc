// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/overlay_lines.h"

namespace codesign {
namespace {

/// Replaces each `from` by `to`, which may contain it.
std::string with_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

void OverlayLines::say(std::string sentence) {
  // Two hyphens end a comment.
  for (std::size_t at = sentence.find("--"); at != std::string::npos; at = sentence.find("--", at))
    sentence.insert(at + 1, " ");
  text_ += "\n  <!-- " + sentence + " -->\n";
}

// In a comment, too, two hyphens are not there as characters by number.
std::string attribute_text(std::string text) {
  text = with_all(with_all(std::move(text), "&", "&amp;"), "<", "&lt;");
  return '"' + with_all(with_all(std::move(text), "\"", "&quot;"), "--", "-&#45;") + '"';
}

std::string element_named(const char* tag, const std::string& name, const std::string& content) {
  return std::string("<") + tag + " name=" + attribute_text(name) + ">" + content + "</" + tag +
         ">";
}

SourceText as_overlay(const std::string& name, const std::string& content) {
  return {name, "<robot name=" + attribute_text(name) +
                    " xmlns:codesign=\"urn:mechanism_codesign\">\n" + content + "</robot>\n"};
}

}  // namespace codesign
