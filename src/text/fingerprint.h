// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace codesign {

/// 64 bits that distinguish texts that differ by accident, as 16 hexadecimal digits: FNV-1a
/// (Fowler, Noll and Vo), the same on every machine. No protection against forgery.
std::string fingerprint(const std::string& text);

/// A JSON object in one line with one more key, the last one: `checksum`, the fingerprint of the
/// text before this key.
/// @param object text that ends with the closing brace of an object that is not empty.
std::string with_checksum(std::string object);

/// Whether `text` is a text of with_checksum() of which no byte has changed. A change of a single
/// byte is always found.
bool has_right_checksum(const std::string& text);

}  // namespace codesign
