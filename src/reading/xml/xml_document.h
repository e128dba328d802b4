// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_XML_XML_DOCUMENT_H_
#define MECHANISM_CODESIGN_READING_XML_XML_DOCUMENT_H_

#include <tinyxml2.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "mechanism_codesign/error.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// A `<robot>` document that knows, for every element and attribute, the file and line it came from, also after overlays were merged in.
class XmlDocument {
 public:
  /// @throws InputError if the text is no XML or its root is not `<robot>`.
  explicit XmlDocument(const SourceText& source);

  const std::string& file() const { return file_; }
  tinyxml2::XMLElement* robot() { return dom_->RootElement(); }
  const tinyxml2::XMLElement* robot() const { return dom_->RootElement(); }
  std::string text() const;

  /// What was doubtful while the document was made of its files.
  const Warnings& warnings() const { return warnings_; }
  void note(const Warnings& warnings) { append(warnings, &warnings_); }

  SourceLocation location(const tinyxml2::XMLElement* element) const;
  SourceLocation location(const tinyxml2::XMLElement* element, const std::string& attribute) const;

  /// Appends to `parent` a copy of an element of another document, with its children and locations.
  tinyxml2::XMLElement* append_copy(tinyxml2::XMLElement* parent, const tinyxml2::XMLElement* original, const XmlDocument& source);
  /// Sets the attributes of `target` to those of `original`, and remembers where they came from.
  void copy_attributes(tinyxml2::XMLElement* target, const tinyxml2::XMLElement* original, const XmlDocument& source);

 private:
  std::string file_;
  Warnings warnings_;
  std::unique_ptr<tinyxml2::XMLDocument> dom_;
  std::map<const tinyxml2::XMLElement*, SourceLocation> foreign_elements_;
  std::map<std::pair<const tinyxml2::XMLElement*, std::string>, SourceLocation> foreign_attributes_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_XML_XML_DOCUMENT_H_
