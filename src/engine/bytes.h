// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "math/arrays.h"

namespace codesign {

template <class T>
inline constexpr bool kIsNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Writes values one after another, with the bits that they have in memory. The reader must be a
/// process of the same program on a machine of the same kind. A structure has a function
/// members(bytes, x), which calls bytes(...) with its members, for the writer and the reader.
class ByteWriter {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }
  std::string take() { return std::move(bytes_); }

 private:
  template <class T>
  void put(const T& value) {
    if constexpr (kIsNumber<T>)
      append(&value, 1);
    else
      members(*this, const_cast<T&>(value));
  }
  void put(const std::string& text) { put_all(text); }
  void put(const std::vector<double>& values) { put_all(values); }
  template <int Columns>
  void put(const Eigen::Matrix<double, -1, Columns>& matrix) {
    put(static_cast<std::uint64_t>(matrix.rows()));
    put_all(matrix);
  }
  template <class T>
  void put(const std::vector<T>& list) {
    put(static_cast<std::uint64_t>(list.size()));
    for (const T& one : list) put(one);
  }
  template <class Values>
  void put_all(const Values& values) {
    put(static_cast<std::uint64_t>(values.size()));
    append(values.data(), to_index(values.size()));
  }
  template <class T>
  void append(const T* data, std::size_t count) {
    bytes_.append(reinterpret_cast<const char*>(data), count * sizeof(T));
  }

  std::string bytes_;
};

/// Reads what a ByteWriter has written. @throws std::runtime_error if the bytes end too early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (read(values), ...);
  }
  template <class T>
  T get() {
    T value{};
    read(value);
    return value;
  }
  bool at_end() const { return rest_.empty(); }

 private:
  template <class T>
  void read(T& value) {
    if constexpr (kIsNumber<T>)
      copy(&value, 1);
    else
      members(*this, value);
  }
  void read(std::string& text) {
    text.resize(count(1));
    copy(text.data(), text.size());
  }
  void read(std::vector<double>& values) {
    values.resize(count(sizeof(double)));
    copy(values.data(), values.size());
  }
  template <int Columns>
  void read(Eigen::Matrix<double, -1, Columns>& matrix) {
    const auto rows = get<std::uint64_t>();
    const std::size_t size = count(sizeof(double));
    matrix.resize(to_signed(rows), rows == 0 ? Columns == 1 : to_signed(size / rows));
    if (to_index(matrix.size()) != size) fail();
    copy(matrix.data(), size);
  }
  template <class T>
  void read(std::vector<T>& list) {
    list.clear();
    for (std::size_t left = count(1); left > 0; --left) list.push_back(get<T>());
  }
  /// The number of elements that follow. The check keeps a damaged number from reserving all
  /// memory.
  std::size_t count(std::size_t size_of_one) {
    const auto size = get<std::uint64_t>();
    if (size > rest_.size() / size_of_one) fail();
    return to_index(size);
  }
  template <class T>
  void copy(T* values, std::size_t count) {
    const std::size_t size = count * sizeof(T);
    if (size > rest_.size()) fail();
    if (size > 0) std::memcpy(values, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  [[noreturn]] static void fail() {
    throw std::runtime_error("a message between processes is damaged: it ends too early");
  }

  std::string_view rest_;
};

}  // namespace codesign
