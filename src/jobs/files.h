// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace codesign {

/// A failure outside the main computation, such as a file that could not be written or a recorded
/// run that ended early.
struct Failure {
  std::string code;  ///< snake case, for `error.code`
  std::string message;
};

/// A result could not be written, for example because the disk is full or the folder is not
/// writable. Not a case of bad input.
///
/// `what()` reads `path: cannot be written: No space left on device`.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::string& path, const std::string& cause);

  /// An error with the system's text for the cause. @param number errno of the failed call; 0:
  /// unknown cause.
  static OutputError of_system(const std::string& path, int number);
};

/// Suffix of a file that write_whole_file() has not finished.
inline constexpr const char* kPartSuffix = ".part";

/// Writes an output that a user names. A file is written beside itself, with kPartSuffix, and
/// renamed when it is complete, so that it is never half-written, even if the process is killed; an
/// existing one is replaced and keeps its permissions. A link stays, and the file that it leads to
/// is replaced. Devices, FIFOs and streams such as /dev/stdout stay what they are and get the text.
/// @throws OutputError if that fails, and for a folder; the former file is there then, and no part.
void write_whole_file(const std::string& path, const std::string& text);

/// Renames the finished file `active` to `path`, which must not exist. @throws OutputError if it
/// exists or renaming fails.
void give_final_name(const std::string& active, const std::string& path);

/// Checks that an output does not replace a file that is read, by its own path, a link or another
/// path to the same file.
/// @param option the option with the path. @param what the output, for the message. @throws
/// InputError
void require_no_input(const std::string& path, const std::string& option, const std::string& what,
                      const std::vector<std::string>& inputs);

/// Creates a folder and the folders above it. @throws InputError that names the option, if that
/// fails.
void make_folder(const std::string& path, const std::string& option);

/// A lock file (flock) that exists while a process works on the files that it protects. The system
/// releases the lock at every end of the process, so that an unlocked file is the file of a killed
/// process. The destructor removes the file.
class LockFile {
 public:
  /// Creates and locks `path`; nullopt if it exists. @throws OutputError if it cannot be created.
  static std::optional<LockFile> create(const std::string& path);

  /// Locks `path`, which is created if needed; nullopt if another process holds the lock. @throws
  /// OutputError if it cannot be created or locked.
  static std::optional<LockFile> take(const std::string& path);

  /// Locks `path` if it was left behind by a killed process; nullopt if it does not exist, is
  /// locked, or cannot be locked.
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
