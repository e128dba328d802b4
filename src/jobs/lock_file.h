// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace codesign {

/// A lock file (flock) that exists while a process works on the files that it protects. The system releases the lock at every end of the
/// process, so that an unlocked file is the file of a killed process. The destructor removes the file.
class LockFile {
 public:
  /// Creates and locks `path`; nullopt if it exists. @throws OutputError if it cannot be created.
  static std::optional<LockFile> create(const std::string& path);

  /// Locks `path`, which is created if needed; nullopt if another process holds the lock. @throws OutputError if it cannot be created or
  /// locked.
  static std::optional<LockFile> take(const std::string& path);

  /// Locks `path` if it was left behind by a killed process; nullopt if it does not exist, is locked, or cannot be locked.
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
