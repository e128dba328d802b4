// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace codesign {

/// Decompresses a chunk of a bag. The result grows with what is decompressed, so that a wrong `size` allocates nothing.
/// @param compression none, bz2 or lz4. @param size of the result, which is checked.
/// @throws BagFault without a place if the bytes are not such data of this size.
std::string unpack_chunk(const std::string& compression, std::string packed, std::uint64_t size);

}  // namespace codesign
