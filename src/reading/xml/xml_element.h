// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism_codesign/warning.h"
#include "reading/xml/xml_document.h"

namespace codesign {

/// Read access to one element. Its errors name file, line and element. It refers to the document,
/// which must outlive it.
class XmlElement {
 public:
  XmlElement(const tinyxml2::XMLElement* node, const XmlDocument* document)
      : node_(node), document_(document) {}

  const tinyxml2::XMLElement* node() const { return node_; }
  std::string tag() const { return node_->Name(); }
  /// The path from a child of `<robot>` to this element, for example `<joint name="crank_joint">
  /// <origin>`.
  std::string label() const;
  SourceLocation where() const { return document_->location(node_); }
  SourceLocation where(const std::string& attribute) const {
    return document_->location(node_, attribute);
  }

  /// Whether the element, or the attribute, comes from an overlay. Overlays are written for this
  /// package, so they are read strictly.
  bool in_overlay() const { return where().file != document_->file(); }
  bool in_overlay(const std::string& attribute) const {
    return where(attribute).file != document_->file();
  }

  bool has(const std::string& attribute) const {
    return node_->FindAttribute(attribute.c_str()) != nullptr;
  }
  std::optional<std::string> find(const std::string& attribute) const;
  /// The value of an attribute. @throws InputError if it is missing or empty.
  std::string text(const std::string& attribute) const;
  std::vector<std::string> attributes() const;

  std::vector<XmlElement> children() const;
  std::vector<XmlElement> children(const std::string& tag) const;
  /// The first child with that tag, as other readers of URDF take it; check_vocabulary() warns of
  /// further ones.
  std::optional<XmlElement> child(const std::string& tag) const;
  /// Likewise. @throws InputError if there is none.
  XmlElement only(const std::string& tag) const;

  /// A warning about the element, or about one of its attributes.
  /// @param message the doubtful value and its treatment. @param remedy the change that avoids the
  /// warning.
  Warning warning(const std::string& code, const std::string& message, const std::string& value,
                  const std::string& remedy) const;
  Warning warning_at(const std::string& code, const std::string& attribute,
                     const std::string& message, const std::string& remedy) const;

  /// Throws InputError for the element, or for one of its attributes.
  [[noreturn]] void fail(const std::string& message, const std::string& value = "",
                         const std::string& allowed = "") const;
  [[noreturn]] void fail_at(const std::string& attribute, const std::string& message,
                            const std::string& allowed = "") const;

 private:
  const tinyxml2::XMLElement* node_;
  const XmlDocument* document_;
};

/// The first child of `parent` with this tag and name; null if there is none.
tinyxml2::XMLElement* find_named(tinyxml2::XMLElement* parent, const char* tag,
                                 const std::string& name);

}  // namespace codesign
