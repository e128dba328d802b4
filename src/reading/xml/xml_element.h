// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_XML_XML_ELEMENT_H_
#define MECHANISM_CODESIGN_READING_XML_XML_ELEMENT_H_

#include <optional>
#include <string>
#include <vector>

#include "mechanism_codesign/warning.h"
#include "reading/xml/xml_document.h"

namespace codesign {

/// Read access to one element, whose complaints name file, line and element. Refers to the document, which must outlive it.
class XmlElement {
 public:
  XmlElement(const tinyxml2::XMLElement* node, const XmlDocument* document) : node_(node), document_(document) {}

  const tinyxml2::XMLElement* node() const { return node_; }
  std::string tag() const { return node_->Name(); }
  /// The way from `<robot>`'s child down to here, e.g. `<joint name="crank_joint"> <origin>`.
  std::string label() const;
  SourceLocation where() const { return document_->location(node_); }
  SourceLocation where(const std::string& attribute) const { return document_->location(node_, attribute); }

  /// Whether an overlay wrote the element, or the attribute: there everything is meant for us.
  bool in_overlay() const { return where().file != document_->file(); }
  bool in_overlay(const std::string& attribute) const { return where(attribute).file != document_->file(); }

  bool has(const std::string& attribute) const { return node_->FindAttribute(attribute.c_str()) != nullptr; }
  std::optional<std::string> find(const std::string& attribute) const;
  /// @throws InputError if it is missing or empty.
  std::string text(const std::string& attribute) const;
  std::vector<std::string> attributes() const;

  std::vector<XmlElement> children() const;
  std::vector<XmlElement> children(const std::string& tag) const;
  /// The child of that tag, or none. Of several the first, as URDF's readers do; check_vocabulary() tells of the others.
  std::optional<XmlElement> child(const std::string& tag) const;
  /// @throws InputError if there is none.
  XmlElement only(const std::string& tag) const;

  /// A warning about the element, or about one of its attributes.
  /// @param message what is doubtful, and what was done. @param remedy what to write to silence the warning.
  Warning warning(const std::string& code, const std::string& message, const std::string& value, const std::string& remedy) const;
  Warning warning_at(const std::string& code, const std::string& attribute, const std::string& message, const std::string& remedy) const;

  [[noreturn]] void fail(const std::string& message, const std::string& value = "", const std::string& allowed = "") const;
  [[noreturn]] void fail_at(const std::string& attribute, const std::string& message, const std::string& allowed = "") const;

 private:
  const tinyxml2::XMLElement* node_;
  const XmlDocument* document_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_XML_XML_ELEMENT_H_
