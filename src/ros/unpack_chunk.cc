// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/unpack_chunk.h"

#include <bzlib.h>
#include <lz4frame.h>

#include <memory>
#include <utility>

#include "ros/byte_reader.h"

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
    if (done.failed || (done.consumed == 0 && done.produced == 0 && !done.is_last)) throw BagFault("data that cannot be decompressed");
    packed.remove_prefix(done.consumed);
    all.append(part, 0, done.produced);
    if (all.size() > size) break;
  }
  if (all.size() != size) throw BagFault("data that decompress to another size than the " + std::to_string(size) + " bytes announced");
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
    return Part{source.size() - stream.avail_in, part->size() - stream.avail_out, result == BZ_STREAM_END,
                result != BZ_OK && result != BZ_STREAM_END};
  });
}

std::string unpack_lz4(std::string_view packed, std::uint64_t size) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> end(context, LZ4F_freeDecompressionContext);
  return unpack(packed, size, [context](std::string_view source, std::string* part) {
    std::size_t consumed = source.size(), produced = part->size();
    const std::size_t result = LZ4F_decompress(context, part->data(), &produced, source.data(), &consumed, nullptr);
    return Part{consumed, produced, result == 0, LZ4F_isError(result) != 0};
  });
}

}  // namespace

std::string unpack_chunk(const std::string& compression, std::string packed, std::uint64_t size) {
  if (compression == "bz2") return unpack_bz2(packed, size);
  if (compression == "lz4") return unpack_lz4(packed, size);
  if (compression != "none") throw BagFault("an unknown compression \"" + compression + "\"");
  if (packed.size() != size) throw BagFault(std::to_string(packed.size()) + " bytes of data instead of " + std::to_string(size));
  return packed;
}

}  // namespace codesign
