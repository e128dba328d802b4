// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mechanism_codesign/source_text.h"

namespace codesign {

/// The text of an overlay that is written for a person: comments, elements, and elements in a
/// comment, which are read once the marks of the comment are taken away.
class OverlayLines {
 public:
  void say(std::string sentence);
  void add(const std::string& element) { text_ += "  " + element + '\n'; }
  void to_fill_in(const std::string& element) { text_ += "  <!-- " + element + " -->\n"; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// The value of an attribute with its quotation marks, also for an element in a comment.
std::string attribute_text(std::string text);

/// `<TAG name="NAME">CONTENT</TAG>`
std::string element_named(const char* tag, const std::string& name, const std::string& content);

/// An overlay with this content. @param name of the robot that it is, and of the text in messages.
SourceText as_overlay(const std::string& name, const std::string& content);

}  // namespace codesign
