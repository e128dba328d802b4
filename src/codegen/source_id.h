// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <typeindex>

namespace codesign {

/// Identifies the object that an input of a recording is computed from: an expression, or a function of time. The object keeps its type, so
/// that code generation need not know it and its reader cannot take it for another. It must outlive the id.
class SourceId {
 public:
  template <class Source>
  explicit SourceId(const Source& source) : address_(&source), type_(typeid(Source)) {}

  /// The object, or null if it is of another type.
  template <class Source>
  const Source* as() const {
    return type_ == typeid(Source) ? static_cast<const Source*>(address_) : nullptr;
  }
  bool operator==(const SourceId& other) const { return address_ == other.address_ && type_ == other.type_; }

 private:
  const void* address_;
  std::type_index type_;
};

}  // namespace codesign
