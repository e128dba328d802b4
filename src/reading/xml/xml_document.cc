// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/xml/xml_document.h"

#include <algorithm>

#include "math/arrays.h"

namespace codesign {
namespace {

/// A sentence for the user in place of tinyxml2's name of the error.
std::string parse_fault(tinyxml2::XMLError error) {
  switch (error) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "it is empty";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element that begins here does not end, or another one ends in its place";
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return "a tag that begins here is broken off or malformed";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "a tag has an attribute that is malformed, without quotation marks, or given twice";
    case tinyxml2::XML_ERROR_PARSING:
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "the text between two tags, or the file, ends too early";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment does not end";
    case tinyxml2::XML_ERROR_PARSING_CDATA:
      return "a CDATA section does not end";
    case tinyxml2::XML_ERROR_PARSING_DECLARATION:
      return "the XML declaration is malformed or not at the beginning";
    case tinyxml2::XML_ERROR_PARSING_UNKNOWN:
      return "a declaration that begins with <! does not end, or is not allowed here";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested too deeply";
    default:
      return tinyxml2::XMLDocument::ErrorIDToName(error);
  }
}

/// Replaces an XML declaration before the root element by spaces, unless the text begins with it.
/// @returns its line; 0 if there is none.
int blank_late_declaration(std::string* text) {
  std::size_t at = 0;
  while (true) {
    at = text->find_first_not_of(" \t\r\n", at);
    if (at == std::string::npos || text->compare(at, 4, "<!--") != 0) break;
    at = text->find("-->", at);
    if (at == std::string::npos) break;
    at += 3;
  }
  if (at == std::string::npos || at == 0 || text->compare(at, 6, "<?xml ") != 0) return 0;
  const std::size_t end = text->find("?>", at);
  if (end == std::string::npos) return 0;
  for (std::size_t k = at; k < end + 2; ++k)
    if ((*text)[k] != '\n') (*text)[k] = ' ';
  return 1 + static_cast<int>(std::count(text->begin(), text->begin() + to_signed(at), '\n'));
}

}  // namespace

XmlDocument::XmlDocument(const SourceText& source)
    : file_(source.name),
      origins_(source.origins),
      dom_(std::make_unique<tinyxml2::XMLDocument>()) {
  tinyxml2::XMLError fault = dom_->Parse(source.text.c_str(), source.text.size());
  if (fault == tinyxml2::XML_ERROR_PARSING_DECLARATION) {
    std::string text = source.text;
    if (const int line = blank_late_declaration(&text); line > 0) {
      fault = dom_->Parse(text.c_str(), text.size());
      warnings_.push_back(
          warn("late_declaration",
               {{file_, line},
                "",
                "the XML declaration stands after a comment; it is ignored, and other readers may "
                "refuse the file; to silence this: move it to the beginning of the file",
                "<?xml",
                ""}));
    }
  }
  if (fault != tinyxml2::XML_SUCCESS)
    throw InputError({{file_, std::max(1, dom_->ErrorLineNum())},
                      "",
                      "the text is not XML: " + parse_fault(dom_->ErrorID()),
                      "",
                      "a URDF file; & and < in a text or an attribute are written &amp; and &lt;"});
  if (robot() == nullptr)
    throw InputError({{file_, 1}, "", "the text contains no XML element", "", "<robot>"});
  if (std::string(robot()->Name()) != "robot")
    throw InputError({location(robot()), "", "the root element is not a robot",
                      std::string("<") + robot()->Name() + ">", "<robot>"});
}

std::string XmlDocument::text(bool compact) const {
  tinyxml2::XMLPrinter printer(nullptr, compact);
  dom_->Print(&printer);
  return printer.CStr();
}

SourceLocation XmlDocument::location(const tinyxml2::XMLElement* element) const {
  const auto found = foreign_elements_.find(element);
  return found != foreign_elements_.end() ? found->second : at_line(element->GetLineNum());
}

SourceLocation XmlDocument::at_line(int line) const {
  if (line >= 1 && to_index(line) <= origins_.size() && origins_[to_index(line - 1)].line > 0)
    return origins_[to_index(line - 1)];
  return {file_, line};
}

SourceLocation XmlDocument::location(const tinyxml2::XMLElement* element,
                                     const std::string& attribute) const {
  const auto found = foreign_attributes_.find({element, attribute});
  if (found != foreign_attributes_.end()) return found->second;
  const tinyxml2::XMLAttribute* own = element->FindAttribute(attribute.c_str());
  if (own == nullptr || foreign_elements_.count(element) != 0) return location(element);
  return at_line(own->GetLineNum());
}

tinyxml2::XMLElement* XmlDocument::append_new(tinyxml2::XMLElement* parent, const char* tag,
                                              const SourceLocation& where) {
  tinyxml2::XMLElement* element = dom_->NewElement(tag);
  parent->InsertEndChild(element);
  foreign_elements_[element] = where;
  return element;
}

tinyxml2::XMLElement* XmlDocument::append_copy(tinyxml2::XMLElement* parent,
                                               const tinyxml2::XMLElement* original,
                                               const XmlDocument& source) {
  tinyxml2::XMLElement* copy = dom_->NewElement(original->Name());
  parent->InsertEndChild(copy);
  foreign_elements_[copy] = source.location(original);
  copy_attributes(copy, original, source);
  for (const tinyxml2::XMLElement* child = original->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement())
    append_copy(copy, child, source);
  return copy;
}

void XmlDocument::copy_attributes(tinyxml2::XMLElement* target,
                                  const tinyxml2::XMLElement* original, const XmlDocument& source) {
  for (const tinyxml2::XMLAttribute* attribute = original->FirstAttribute(); attribute != nullptr;
       attribute = attribute->Next()) {
    target->SetAttribute(attribute->Name(), attribute->Value());
    foreign_attributes_[{target, attribute->Name()}] = source.location(original, attribute->Name());
  }
}

}  // namespace codesign
