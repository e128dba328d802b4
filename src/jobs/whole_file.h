// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOBS_WHOLE_FILE_H_
#define MECHANISM_CODESIGN_JOBS_WHOLE_FILE_H_

#include <string>

namespace codesign {

/// What stands behind the name of a file that write_whole_file() has not finished.
inline constexpr const char* kPartSuffix = ".part";

/// Writes `path`.part and gives it its name when it is whole, so that `path` is never half-written, even if the process is killed. A file
/// of that name is replaced. @throws OutputError, having removed the part.
void write_whole_file(const std::string& path, const std::string& text);

/// Gives the finished file `active` its final name `path`, which must not exist. @throws OutputError
void give_final_name(const std::string& active, const std::string& path);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOBS_WHOLE_FILE_H_
