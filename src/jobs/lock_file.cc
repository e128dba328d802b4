// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/lock_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "jobs/output_error.h"

namespace codesign {
namespace {

constexpr mode_t kMode = 0666;

int open_at(const std::string& path, int flags) { return open(path.c_str(), flags | O_RDWR | O_CLOEXEC, kMode); }

}  // namespace

LockFile::LockFile(LockFile&& other) noexcept : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

LockFile& LockFile::operator=(LockFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

LockFile::~LockFile() {
  if (descriptor_ < 0) return;
  // Removed while still locked, so that no other process can have taken it.
  if (is_at_its_path()) unlink(path_.c_str());
  close(descriptor_);
}

bool LockFile::is_at_its_path() const {
  struct stat mine {};
  struct stat there {};
  return fstat(descriptor_, &mine) == 0 && stat(path_.c_str(), &there) == 0 && mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
}

std::optional<LockFile> LockFile::create(const std::string& path) {
  const int descriptor = open_at(path, O_CREAT | O_EXCL);
  if (descriptor < 0 && errno == EEXIST) return std::nullopt;
  if (descriptor < 0) throw OutputError::of_system(path, errno);
  LockFile file(path, descriptor);
  // Exclusive creation reserves the name even on file systems without locks. Between the two calls another process may have mistaken the
  // file for an abandoned one and removed it, which the check below detects.
  flock(descriptor, LOCK_EX);
  if (!file.is_at_its_path()) return std::nullopt;
  return file;
}

std::optional<LockFile> LockFile::take(const std::string& path) {
  while (true) {
    const int descriptor = open_at(path, O_CREAT);
    if (descriptor < 0) throw OutputError::of_system(path, errno);
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      const int cause = errno;
      close(descriptor);
      if (cause == EWOULDBLOCK) return std::nullopt;
      throw OutputError::of_system(path, cause);
    }
    LockFile file(path, descriptor);
    if (file.is_at_its_path()) return file;
  }
}

std::optional<LockFile> LockFile::take_abandoned(const std::string& path) {
  const int descriptor = open_at(path, O_NOFOLLOW);
  if (descriptor < 0) return std::nullopt;
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    close(descriptor);
    return std::nullopt;
  }
  LockFile file(path, descriptor);
  if (!file.is_at_its_path()) return std::nullopt;
  return file;
}

}  // namespace codesign
