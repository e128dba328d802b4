// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "text/fingerprint.h"

#include <cstdint>

namespace codesign {
namespace {

/// What with_checksum() puts behind the text before it.
std::string checksum_end(const std::string& text) {
  return ",\"checksum\":\"" + fingerprint(text) + "\"}";
}

}  // namespace

std::string fingerprint(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  std::string digits(16, '0');
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, hash >>= 4)
    *digit = "0123456789abcdef"[hash & 0xf];
  return digits;
}

std::string with_checksum(std::string object) {
  object.pop_back();
  return object + checksum_end(object);
}

bool has_right_checksum(const std::string& text) {
  const std::size_t length = checksum_end("").size();
  if (text.size() < length) return false;
  const std::size_t end = text.size() - length;
  return text.compare(end, length, checksum_end(text.substr(0, end))) == 0;
}

}  // namespace codesign
