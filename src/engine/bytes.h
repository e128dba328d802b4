// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "math/arrays.h"

namespace codesign {

/// Writes numbers and texts one after another, with the bits that they have in memory. The reader
/// must be a process of the same program on a machine of the same kind.
class ByteWriter {
 public:
  template <class T>
  void add(T value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>,
                  "bytes of structures may be padding");
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void add_text(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    bytes_.append(text);
  }
  /// A range of doubles with its size.
  template <class Values>
  void add_numbers(const Values& values) {
    add(static_cast<std::uint64_t>(values.size()));
    bytes_.append(reinterpret_cast<const char*>(values.data()),
                  to_index(values.size()) * sizeof(double));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter has written. @throws std::runtime_error if the bytes end too early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string get_text() { return std::string(take(count(1))); }
  /// Numbers into a container that can be constructed from its size: a vector of the standard
  /// library or of Eigen.
  template <class Values>
  Values get_numbers() {
    const std::size_t size = count(sizeof(double));
    Values values(static_cast<decltype(values.size())>(size));
    const std::string_view bytes = take(size * sizeof(double));
    if (size > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  bool at_end() const { return rest_.empty(); }

 private:
  /// The number of elements that follow. The check keeps a damaged number from reserving all
  /// memory.
  std::size_t count(std::size_t size_of_one) {
    const auto size = get<std::uint64_t>();
    if (size > rest_.size() / size_of_one) fail();
    return to_index(size);
  }
  std::string_view take(std::size_t size) {
    if (size > rest_.size()) fail();
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  [[noreturn]] static void fail() {
    throw std::runtime_error("a message between processes is damaged: it ends too early");
  }

  std::string_view rest_;
};

}  // namespace codesign
