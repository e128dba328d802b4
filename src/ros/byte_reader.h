// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace codesign {

/// Thrown where the bytes of a bag contradict its format; what() names the place in the file.
class BagFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads numbers and blocks one after the other, in the byte order of ROS, which is that of the processor. No length is believed: each is
/// compared with the bytes that are left before anything is read or allocated.
class ByteReader {
 public:
  /// @param first place of the first byte in the file, for messages. @param within what the place counts in if not in the file, such as
  /// " of the chunk at byte 4117, decompressed"; must outlive the reader.
  explicit ByteReader(std::string_view bytes, std::uint64_t first = 0, std::string_view within = {})
      : bytes_(bytes), first_(first), within_(within) {}

  bool at_end() const { return read_ == bytes_.size(); }
  std::uint64_t place() const { return first_ + read_; }

  std::string_view bytes(std::uint64_t count, const char* what) {
    const std::size_t left = bytes_.size() - read_;
    if (count > left) fail(std::string(what) + " of " + std::to_string(count) + " bytes, with " + std::to_string(left) + " bytes left,");
    read_ += static_cast<std::size_t>(count);
    return bytes_.substr(read_ - static_cast<std::size_t>(count), static_cast<std::size_t>(count));
  }

  template <class T>
  T number(const char* what) {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    std::memcpy(&value, bytes(sizeof value, what).data(), sizeof value);
    return value;
  }

  /// A length of four bytes and that many bytes.
  std::string_view block(const char* what) { return bytes(number<std::uint32_t>(what), what); }

  /// A reader of a block.
  ByteReader inner(const char* what) {
    const std::string_view block = this->block(what);
    return ByteReader(block, place() - block.size(), within_);
  }

  /// A number of entries of four bytes and the entries.
  std::vector<double> doubles(const char* what) {
    const std::uint64_t count = number<std::uint32_t>(what);
    const std::string_view all = bytes(count * sizeof(double), what);
    std::vector<double> values(static_cast<std::size_t>(count));
    if (count > 0) std::memcpy(values.data(), all.data(), all.size());
    return values;
  }
  std::vector<std::string> strings(const char* what) {
    std::vector<std::string> values;
    for (std::uint64_t left = number<std::uint32_t>(what); left > 0; --left) values.emplace_back(block(what));
    return values;
  }

  /// Seconds and nanoseconds as nanoseconds.
  std::int64_t time(const char* what) {
    const std::int64_t seconds = number<std::uint32_t>(what), nanoseconds = number<std::uint32_t>(what);
    constexpr std::int64_t kSecond = 1000000000;
    if (nanoseconds >= kSecond) fail(std::string(what) + " with " + std::to_string(nanoseconds) + " nanoseconds");
    return seconds * kSecond + nanoseconds;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw BagFault(message + " at byte " + std::to_string(place()) + std::string(within_));
  }

 private:
  std::string_view bytes_;
  std::uint64_t first_;
  std::string_view within_;
  std::size_t read_ = 0;
};

}  // namespace codesign
