// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/error.h"

#include <utility>

namespace codesign {
namespace {

/// A text longer than `most` bytes is cut and ends with "...", so that messages stay readable.
std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // do not cut a UTF-8 character
  return text.substr(0, end) + "...";
}

InputFault shortened(InputFault fault) {
  for (std::string* part : {&fault.element, &fault.value}) *part = shortened(*part, 300);
  for (std::string* part : {&fault.message, &fault.allowed}) *part = shortened(*part, 1000);  // these may show an element to write
  return fault;
}

std::string describe(const InputFault& fault) {
  std::string text = fault.where.file;
  if (fault.where.line > 0) text += ":" + std::to_string(fault.where.line);
  if (!text.empty()) text += ": ";
  if (!fault.element.empty()) text += fault.element + ": ";
  text += fault.message;
  if (fault.value.empty() && fault.allowed.empty()) return text;
  text += " (";
  if (!fault.value.empty()) text += "value: " + fault.value;
  if (!fault.value.empty() && !fault.allowed.empty()) text += ", ";
  if (!fault.allowed.empty()) text += "allowed: " + fault.allowed;
  return text + ")";
}

}  // namespace

InputError::InputError(InputFault fault) : std::runtime_error(describe(shortened(fault))), fault_(shortened(std::move(fault))) {}

}  // namespace codesign
