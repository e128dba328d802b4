// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "math/arrays.h"

namespace codesign {

/// Thrown where the bytes of a bag contradict its format; what() names the place in the file.
class BagFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads numbers and blocks one after the other, in the byte order of ROS, which is that of the
/// processor. No length is believed: each is compared with the bytes that are left before anything
/// is read or allocated.
class BagCursor {
 public:
  /// @param first place of the first byte in the file, for messages. @param within what the place
  /// counts in if not in the file, such as " of the chunk at byte 4117, decompressed"; must outlive
  /// the reader.
  explicit BagCursor(std::string_view bytes, std::uint64_t first = 0, std::string_view within = {})
      : bytes_(bytes), first_(first), within_(within) {}

  bool at_end() const { return read_ == bytes_.size(); }
  std::uint64_t place() const { return first_ + read_; }

  std::string_view bytes(std::uint64_t count, const char* what) {
    const std::size_t left = bytes_.size() - read_;
    if (count > left)
      fail(std::string(what) + " of " + std::to_string(count) + " bytes, with " +
           std::to_string(left) + " bytes left,");
    read_ += to_index(count);
    return bytes_.substr(read_ - to_index(count), to_index(count));
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
  BagCursor inner(const char* what) {
    const std::string_view block = this->block(what);
    return BagCursor(block, place() - block.size(), within_);
  }

  /// A number of entries of four bytes and the entries.
  std::vector<double> doubles(const char* what) {
    const std::uint64_t count = number<std::uint32_t>(what);
    const std::string_view all = bytes(count * sizeof(double), what);
    std::vector<double> values(to_index(count));
    if (count > 0) std::memcpy(values.data(), all.data(), all.size());
    return values;
  }
  std::vector<std::string> strings(const char* what) {
    std::vector<std::string> values;
    for (std::uint64_t left = number<std::uint32_t>(what); left > 0; --left)
      values.emplace_back(block(what));
    return values;
  }

  /// Seconds and nanoseconds as nanoseconds.
  std::int64_t time(const char* what) {
    const std::int64_t seconds = number<std::uint32_t>(what),
                       nanoseconds = number<std::uint32_t>(what);
    constexpr std::int64_t kSecond = 1000000000;
    if (nanoseconds >= kSecond)
      fail(std::string(what) + " with " + std::to_string(nanoseconds) + " nanoseconds");
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

/// Thrown if a cancel ends the reading of a bag.
class ReadingCancelled : public std::runtime_error {
 public:
  ReadingCancelled() : std::runtime_error("cancelled") {}
};

/// A bag that its recorder did not close, so that it has no index.
class UnindexedBag : public BagFault {
 public:
  using BagFault::BagFault;
};

/// One publisher's messages on a topic.
struct BagConnection {
  std::string topic, type, md5sum;
};

/// A message as it stands in the bag.
struct BagMessage {
  const BagConnection& connection;
  std::int64_t received;  ///< [ns]
  BagCursor content;
};

/// The messages of a bag of format 2.0, read for files of any content: rosbag_storage believes the
/// lengths in a file, so that one changed byte can end the process. See
/// doc/decisions/0074-bags-are-read-here.md. Chunks without messages of the wanted topic are
/// skipped.
class BagContents {
 public:
  /// Reads the connections and the index. @throws BagFault
  explicit BagContents(const std::string& path);

  /// The connections that have messages.
  std::vector<BagConnection> connections() const;
  bool empty() const { return counts_.empty(); }
  /// Time at which the first message of the bag was received [ns].
  std::int64_t begin() const { return begin_; }
  /// Calls `visit` for all messages of a topic, in the order of the file.
  /// @throws BagFault, ReadingCancelled soon after `cancel` is set, and what `visit` throws.
  void visit(const std::string& topic, const std::atomic<bool>* cancel,
             const std::function<void(const BagMessage&)>& visit);

 private:
  /// messages by the number of their connection
  using Counts = std::map<std::uint32_t, std::uint64_t>;
  struct Chunk {
    std::uint64_t at;  ///< place of its data
    std::uint32_t packed, size;
    std::string compression;
    Counts counts;
  };

  std::string read(std::uint64_t at, std::uint64_t count);
  std::uint64_t read_record(std::uint64_t at);
  void check_first_line();
  void read_file_header(const BagCursor& fields);
  void read_index(BagCursor fields, std::uint64_t at, const std::string& data);
  void read_connection(BagCursor fields, std::uint64_t at, const std::string& data);
  void check_counts() const;
  std::string unpack(const Chunk& chunk);
  void visit_chunk(const Chunk& chunk, const std::string& topic,
                   const std::function<void(const BagMessage&)>& visit);

  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::uint32_t chunks_expected_ = 0, connections_expected_ = 0;
  std::vector<Chunk> chunks_;
  std::map<std::uint32_t, BagConnection> connections_;
  Counts counts_;
  std::int64_t begin_ = INT64_MAX;
};

}  // namespace codesign
