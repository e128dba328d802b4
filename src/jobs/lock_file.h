// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOBS_LOCK_FILE_H_
#define MECHANISM_CODESIGN_JOBS_LOCK_FILE_H_

#include <optional>
#include <string>

namespace codesign {

/// A file that is there, and locked, while a process works on what stands beside it. The system takes the lock back however the process
/// ends, so that a file without a lock was left behind by a killed one. Removed by the destructor.
class LockFile {
 public:
  /// Makes `path`; nothing if it exists. @throws OutputError if it cannot be made.
  static std::optional<LockFile> create(const std::string& path);

  /// Takes `path`, made or left behind; nothing if a living process holds it. @throws OutputError if it cannot be made or locked.
  static std::optional<LockFile> take(const std::string& path);

  /// Takes `path` if it was left behind; nothing if it is not there, or held, or cannot be locked.
  static std::optional<LockFile> take_abandoned(const std::string& path);

  ~LockFile();
  LockFile(LockFile&& other) noexcept;
  LockFile& operator=(LockFile&& other) noexcept;

 private:
  LockFile(const std::string& path, int descriptor) : path_(path), descriptor_(descriptor) {}
  bool is_at_its_path() const;

  std::string path_;
  int descriptor_ = -1;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOBS_LOCK_FILE_H_
