// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The format: https://wiki.ros.org/Bags/Format/2.0. A bag is a line, a file header and records. A
// record is a header of fields NAME=VALUE and data; its kind is the field `op`. Chunks hold
// messages, and after each chunk an index record per connection counts its messages.
#include "ros/bags/bag_contents.h"

#include <bzlib.h>
#include <lz4frame.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "math/arrays.h"
#include "text/cancel.h"

namespace codesign {
namespace {

constexpr std::size_t kPart = std::size_t{1} << 18U;

/// What one call of a decompressor did.
struct Part {
  std::size_t consumed = 0, produced = 0;
  bool is_last = false, failed = false;
};

/// Calls `decompress(source, part, room)` until the data end.
template <class Decompress>
std::string unpack(std::string_view packed, std::uint64_t size, const Decompress& decompress) {
  std::string all, part(kPart, '\0');
  for (Part done; !done.is_last;) {
    done = decompress(packed, &part);
    if (done.failed || (done.consumed == 0 && done.produced == 0 && !done.is_last))
      throw BagFault("data that cannot be decompressed");
    packed.remove_prefix(done.consumed);
    all.append(part, 0, done.produced);
    if (all.size() > size) break;
  }
  if (all.size() != size)
    throw BagFault("data that decompress to another size than the " + std::to_string(size) +
                   " bytes announced");
  return all;
}

std::string unpack_bz2(std::string_view packed, std::uint64_t size) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> end(&stream, BZ2_bzDecompressEnd);
  return unpack(packed, size, [&stream](std::string_view source, std::string* part) {
    stream.next_in = const_cast<char*>(source.data());  // bzip2 reads it only
    stream.avail_in = static_cast<unsigned>(source.size());
    stream.next_out = part->data();
    stream.avail_out = static_cast<unsigned>(part->size());
    const int result = BZ2_bzDecompress(&stream);
    return Part{source.size() - stream.avail_in, part->size() - stream.avail_out,
                result == BZ_STREAM_END, result != BZ_OK && result != BZ_STREAM_END};
  });
}

std::string unpack_lz4(std::string_view packed, std::uint64_t size) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0)
    throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> end(
      context, LZ4F_freeDecompressionContext);
  return unpack(packed, size, [context](std::string_view source, std::string* part) {
    std::size_t consumed = source.size(), produced = part->size();
    const std::size_t result =
        LZ4F_decompress(context, part->data(), &produced, source.data(), &consumed, nullptr);
    return Part{consumed, produced, result == 0, LZ4F_isError(result) != 0};
  });
}

constexpr std::string_view kFirstLine = "#ROSBAG V2.0\n";
constexpr std::string_view kAnyVersion = "#ROS";
constexpr std::uint64_t kMostHeader = 1U << 20U;  // fields are names and numbers of a few bytes
enum : std::uint8_t {
  kMessage = 2,
  kFileHeader = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

/// The value of a field.
std::optional<std::string_view> find_field(BagCursor fields, std::string_view name) {
  while (!fields.at_end()) {
    const std::string_view field = fields.block("a header's field");
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) fields.fail("a header's field without \"=\"");
    if (field.substr(0, equals) == name) return field.substr(equals + 1);
  }
  return std::nullopt;
}

std::string_view field_of(const BagCursor& fields, std::string_view name) {
  if (const std::optional<std::string_view> value = find_field(fields, name)) return *value;
  fields.fail("a record without its field \"" + std::string(name) + "\"");
}

template <class T>
T number_of(const BagCursor& fields, std::string_view name) {
  const std::string_view value = field_of(fields, name);
  if (value.size() != sizeof(T))
    fields.fail("a field \"" + std::string(name) + "\" of " + std::to_string(value.size()) +
                " bytes");
  return BagCursor(value).number<T>("");
}

/// The time of a message, the field `time`.
std::int64_t time_of(const BagCursor& fields) {
  const std::string_view value = field_of(fields, "time");
  return BagCursor(value, fields.place()).time("a time of reception");
}

/// Decompresses a chunk of a bag. The result grows with what is decompressed, so that a wrong
/// `size` allocates nothing.
/// @param compression none, bz2 or lz4. @param size of the result, which is checked.
/// @throws BagFault without a place if the bytes are not such data of this size.
std::string unpack_chunk(const std::string& compression, std::string packed, std::uint64_t size) {
  if (compression == "bz2") return unpack_bz2(packed, size);
  if (compression == "lz4") return unpack_lz4(packed, size);
  if (compression != "none") throw BagFault("an unknown compression \"" + compression + "\"");
  if (packed.size() != size)
    throw BagFault(std::to_string(packed.size()) + " bytes of data instead of " +
                   std::to_string(size));
  return packed;
}

}  // namespace

BagContents::BagContents(const std::string& path) {
  // Anything but a file, such as a pipe, could be waited for without an end.
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown)) throw BagFault("there is no such file");
  if (!std::filesystem::is_regular_file(path, unknown)) throw BagFault("it is not a file");
  errno = 0;
  file_.open(path, std::ios::binary);
  if (!file_) throw BagFault(std::strerror(errno));
  size_ = std::filesystem::file_size(path);
  check_first_line();
  for (std::uint64_t at = kFirstLine.size(); at < size_;) at = read_record(at);
  check_counts();
}

/// Bytes of the file.
std::string BagContents::read(std::uint64_t at, std::uint64_t count) {
  if (at > size_ || count > size_ - at)
    throw BagFault("a record of " + std::to_string(count) + " bytes at byte " + std::to_string(at) +
                   " of a file of " + std::to_string(size_) + " bytes");
  std::string bytes(to_index(count), '\0');
  file_.seekg(static_cast<std::streamoff>(at));
  if (!file_.read(bytes.data(), static_cast<std::streamsize>(count)))
    throw BagFault("the file cannot be read at byte " + std::to_string(at) + ": " +
                   std::strerror(errno));
  return bytes;
}

void BagContents::check_first_line() {
  const std::string line = read(0, std::min<std::uint64_t>(size_, kFirstLine.size()));
  if (line.substr(0, kAnyVersion.size()) != kAnyVersion)
    throw BagFault("it is not a bag: its first line is not \"#ROSBAG V2.0\"");
  if (line != kFirstLine) throw BagFault("its format is not 2.0; `rosbag fix` converts older bags");
}

void BagContents::read_file_header(const BagCursor& fields) {
  if (const auto encryptor = find_field(fields, "encryptor"); encryptor && !encryptor->empty())
    throw BagFault("it is encrypted; `rosbag decrypt` writes it so that it can be read");
  const auto index = number_of<std::uint64_t>(fields, "index_pos");
  if (index == 0) throw UnindexedBag("it has no index");
  if (index > size_)
    throw BagFault("it is cut: its index is at byte " + std::to_string(index) +
                   ", and the file has " + std::to_string(size_) + " bytes");
  connections_expected_ = number_of<std::uint32_t>(fields, "conn_count");
  chunks_expected_ = number_of<std::uint32_t>(fields, "chunk_count");
}

/// Reads a record outside of chunks. @return the place of the next one.
std::uint64_t BagContents::read_record(std::uint64_t at) {
  const std::uint32_t length = BagCursor(read(at, 4)).number<std::uint32_t>("");
  if (length > kMostHeader)
    throw BagFault("a record's header of " + std::to_string(length) + " bytes at byte " +
                   std::to_string(at));
  const std::string header = read(at + 4, length);
  const BagCursor fields(header, at + 4);
  const std::uint64_t data_at = at + 4 + length + 4;
  const std::uint32_t size = BagCursor(read(data_at - 4, 4)).number<std::uint32_t>("");
  if (size > size_ - data_at)
    throw BagFault("a record's data of " + std::to_string(size) + " bytes at byte " +
                   std::to_string(data_at) + " of a file of " + std::to_string(size_) + " bytes");
  const auto kind = number_of<std::uint8_t>(fields, "op");
  if ((kind == kFileHeader) != (at == kFirstLine.size()))
    fields.fail("a file header that is not the first record");
  switch (kind) {
    case kFileHeader:
      read_file_header(fields);
      break;
    case kChunk:
      chunks_.push_back({data_at,
                         size,
                         number_of<std::uint32_t>(fields, "size"),
                         std::string(field_of(fields, "compression")),
                         {}});
      break;
    case kIndex:
      read_index(fields, data_at, read(data_at, size));
      break;
    case kConnection:
      read_connection(fields, data_at, read(data_at, size));
      break;
    case kChunkInfo:
      break;
    default:
      fields.fail("a record of kind " + std::to_string(kind) + " outside of chunks");
  }
  return data_at + size;
}

/// The index of the messages of one connection in the chunk before.
void BagContents::read_index(BagCursor fields, std::uint64_t at, const std::string& data) {
  constexpr std::uint64_t kEntry = 12;
  const std::uint64_t count = number_of<std::uint32_t>(fields, "count");
  if (number_of<std::uint32_t>(fields, "ver") != 1) fields.fail("an index of an unknown version");
  if (data.size() != kEntry * count)
    fields.fail("an index of " + std::to_string(count) + " messages in " +
                std::to_string(data.size()) + " bytes");
  if (chunks_.empty()) fields.fail("an index before the first chunk");
  if (count == 0) return;
  const auto connection = number_of<std::uint32_t>(fields, "conn");
  chunks_.back().counts[connection] += count;
  counts_[connection] += count;
  for (BagCursor entries(data, at); !entries.at_end();) {
    begin_ = std::min(begin_, entries.time("an index's time"));
    entries.bytes(4, "an index's offset");
  }
}

void BagContents::read_connection(BagCursor fields, std::uint64_t at, const std::string& data) {
  const BagCursor more(data, at);
  const BagConnection connection{std::string(field_of(fields, "topic")),
                                 std::string(field_of(more, "type")),
                                 std::string(field_of(more, "md5sum"))};
  const auto id = number_of<std::uint32_t>(fields, "conn");
  if (!connections_.emplace(id, connection).second)
    fields.fail("a second connection " + std::to_string(id));
}

void BagContents::check_counts() const {
  if (chunks_.size() != chunks_expected_ || connections_.size() != connections_expected_)
    throw BagFault("its header announces " + std::to_string(chunks_expected_) + " chunks and " +
                   std::to_string(connections_expected_) + " connections, but it has " +
                   std::to_string(chunks_.size()) + " and " + std::to_string(connections_.size()));
  for (const auto& [id, count] : counts_)
    if (connections_.count(id) == 0)
      throw BagFault("its index lists " + std::to_string(count) + " messages of a connection " +
                     std::to_string(id) + " that it does not have");
}

std::vector<BagConnection> BagContents::connections() const {
  std::vector<BagConnection> used;
  for (const auto& [id, count] : counts_) used.push_back(connections_.at(id));
  return used;
}

void BagContents::visit(const std::string& topic, const std::atomic<bool>* cancel,
                        const std::function<void(const BagMessage&)>& visit) {
  for (const Chunk& chunk : chunks_) {
    if (is_set(cancel)) throw ReadingCancelled();
    const auto has_topic = [&](const auto& count) {
      return connections_.at(count.first).topic == topic;
    };
    if (std::any_of(chunk.counts.begin(), chunk.counts.end(), has_topic))
      visit_chunk(chunk, topic, visit);
  }
}

std::string BagContents::unpack(const Chunk& chunk) {
  try {
    return unpack_chunk(chunk.compression, read(chunk.at, chunk.packed), chunk.size);
  } catch (const BagFault& fault) {
    throw BagFault("a chunk at byte " + std::to_string(chunk.at) + " with " + fault.what());
  }
}

void BagContents::visit_chunk(const Chunk& chunk, const std::string& topic,
                              const std::function<void(const BagMessage&)>& visit) {
  const std::string bytes = unpack(chunk);
  const bool is_packed = chunk.compression != "none";
  const std::string within =
      is_packed ? " of the chunk at byte " + std::to_string(chunk.at) + ", decompressed" : "";
  Counts found;
  for (BagCursor records(bytes, is_packed ? 0 : chunk.at, within); !records.at_end();) {
    const BagCursor fields = records.inner("a record's header");
    const BagCursor data = records.inner("a record's data");
    const auto kind = number_of<std::uint8_t>(fields, "op");
    if (kind == kConnection) continue;
    if (kind != kMessage) fields.fail("a record of kind " + std::to_string(kind) + " in a chunk");
    const auto id = number_of<std::uint32_t>(fields, "conn");
    const auto connection = connections_.find(id);
    if (connection == connections_.end())
      fields.fail("a message of a connection " + std::to_string(id) +
                  " that the bag does not have");
    ++found[id];
    if (connection->second.topic == topic) visit({connection->second, time_of(fields), data});
  }
  if (found != chunk.counts)
    throw BagFault("a chunk at byte " + std::to_string(chunk.at) +
                   " with other messages than its index lists");
}

}  // namespace codesign
