// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml2.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mechanism_codesign/error.h"
#include "mechanism_codesign/source_text.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// A `<robot>` document that knows the file and line of every element and attribute, also of those
/// merged in from overlays.
class XmlDocument {
 public:
  /// @throws InputError if the text is not XML or its root element is not `<robot>`.
  explicit XmlDocument(const SourceText& source);

  /// The name of the URDF file, for messages; overlays have other names.
  const std::string& file() const { return file_; }
  tinyxml2::XMLElement* robot() { return dom_->RootElement(); }
  const tinyxml2::XMLElement* robot() const { return dom_->RootElement(); }
  /// The document as XML. @param compact without line breaks and indentation, for programs
  std::string text(bool compact = false) const;

  /// Warnings from reading and merging the files.
  const Warnings& warnings() const { return warnings_; }
  void note(const Warnings& warnings) { append(warnings, &warnings_); }

  /// The file and line of an element, or of one of its attributes.
  SourceLocation location(const tinyxml2::XMLElement* element) const;
  SourceLocation location(const tinyxml2::XMLElement* element, const std::string& attribute) const;

  /// Appends a new element to `parent`, to be located at `where`.
  tinyxml2::XMLElement* append_new(tinyxml2::XMLElement* parent, const char* tag,
                                   const SourceLocation& where);
  /// Appends to `parent` a copy of an element of another document, with its children and their
  /// locations; returns the copy.
  tinyxml2::XMLElement* append_copy(tinyxml2::XMLElement* parent,
                                    const tinyxml2::XMLElement* original,
                                    const XmlDocument& source);
  /// Copies all attributes of `original`, an element of another document, to `target`, with their
  /// locations.
  void copy_attributes(tinyxml2::XMLElement* target, const tinyxml2::XMLElement* original,
                       const XmlDocument& source);

 private:
  SourceLocation at_line(int line) const;

  std::string file_;
  std::vector<SourceLocation> origins_;  ///< SourceText::origins
  Warnings warnings_;
  std::unique_ptr<tinyxml2::XMLDocument> dom_;
  std::map<const tinyxml2::XMLElement*, SourceLocation> foreign_elements_;
  std::map<std::pair<const tinyxml2::XMLElement*, std::string>, SourceLocation> foreign_attributes_;
};

}  // namespace codesign
