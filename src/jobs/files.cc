// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "mechanism_codesign/error.h"

namespace codesign {
namespace {

constexpr mode_t kMode = 0666;

int open_at(const std::string& path, int flags) {
  return open(path.c_str(), flags | O_RDWR | O_CLOEXEC, kMode);
}

}  // namespace

OutputError::OutputError(const std::string& path, const std::string& cause)
    : std::runtime_error(path + ": cannot be written: " + cause) {}

OutputError OutputError::of_system(const std::string& path, int number) {
  return OutputError(path,
                     number == 0 ? "a write failed" : std::generic_category().message(number));
}

void write_whole_file(const std::string& path, const std::string& text) {
  const std::string part = path + kPartSuffix;
  errno = 0;
  std::ofstream file(part, std::ios::binary);
  file << text;
  file.close();
  if (!file || std::rename(part.c_str(), path.c_str()) != 0) {
    const int cause = errno;
    unlink(part.c_str());
    throw OutputError::of_system(path, cause);
  }
}

void give_final_name(const std::string& active, const std::string& path) {
  // link() never replaces an existing file. rename() is used on file systems without link().
  if (link(active.c_str(), path.c_str()) == 0) {
    unlink(active.c_str());
    return;
  }
  const int cause = errno;
  if (cause == EEXIST) throw OutputError::of_system(path, cause);
  if (std::rename(active.c_str(), path.c_str()) != 0) throw OutputError::of_system(path, errno);
}

void require_no_input(const std::string& path, const std::string& option, const std::string& what,
                      const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code error;
    if (std::filesystem::is_regular_file(input, error) &&
        std::filesystem::equivalent(path, input, error))
      throw InputError({{input, 0},
                        option,
                        what + " would replace this file, which is read",
                        path,
                        "the path of another file"});
  }
}

void make_folder(const std::string& path, const std::string& option) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path))
    throw InputError({{path, 0},
                      option,
                      "the folder cannot be created",
                      path,
                      "a folder that exists or can be created"});
}

LockFile::LockFile(LockFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

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
  return fstat(descriptor_, &mine) == 0 && stat(path_.c_str(), &there) == 0 &&
         mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
}

std::optional<LockFile> LockFile::create(const std::string& path) {
  const int descriptor = open_at(path, O_CREAT | O_EXCL);
  if (descriptor < 0 && errno == EEXIST) return std::nullopt;
  if (descriptor < 0) throw OutputError::of_system(path, errno);
  LockFile file(path, descriptor);
  // Exclusive creation reserves the name even on file systems without locks. Between the two calls
  // another process may have mistaken the file for an abandoned one and removed it, which the check
  // below detects.
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
