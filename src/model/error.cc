// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/model/error.h"

#include <utility>

namespace codesign {
namespace {

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

InputError::InputError(InputFault fault) : std::runtime_error(describe(fault)), fault_(std::move(fault)) {}

}  // namespace codesign
