// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstdio>
#include <filesystem>
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

namespace {

namespace fs = std::filesystem;

/// A file that is being written.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags, mode_t mode)
      : number_(open(path.c_str(), flags | O_WRONLY | O_CLOEXEC, mode)) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  /// Writes all of the text and closes. @returns errno of what failed; 0: nothing has
  int write_all(const std::string& text) {
    if (number_ < 0) return errno;
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t written = write(number_, text.data() + done, text.size() - done);
      if (written < 0 && errno != EINTR) return errno;
      if (written > 0) done += static_cast<std::size_t>(written);
    }
    return close(std::exchange(number_, -1)) == 0 ? 0 : errno;
  }
  int number() const { return number_; }

 private:
  int number_;
};

/// The path to which links lead, also where nothing stands there.
std::string end_of_links(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the system follows
  fs::path place = path;
  std::error_code error;
  for (int k = 0; k < kMostLinks && fs::is_symlink(place, error); ++k) {
    const fs::path target = fs::read_symlink(place, error);
    if (error) break;
    place = target.is_absolute() ? target : place.parent_path() / target;
  }
  return place.string();
}

/// Whether bytes go straight to what stands at a path: a device, a FIFO, or a stream that a shell
/// has opened, such as /dev/stdout, which may lead to a file.
bool is_stream(const std::string& path, const struct stat& there) {
  if (!S_ISREG(there.st_mode)) return true;
  std::error_code error;
  const std::string folder =
      fs::weakly_canonical(fs::path(path).parent_path(), error).string() + "/";
  return folder.rfind("/dev/", 0) == 0 || folder.rfind("/proc/", 0) == 0;
}

}  // namespace

void write_whole_file(const std::string& path, const std::string& text) {
  struct stat there {};
  const bool exists = stat(path.c_str(), &there) == 0;
  if (!exists && errno == ELOOP) throw OutputError::of_system(path, ELOOP);
  if (exists && S_ISDIR(there.st_mode)) throw OutputError::of_system(path, EISDIR);
  if (exists && is_stream(path, there)) {
    if (const int fault = Descriptor(path, 0, kMode).write_all(text); fault != 0)
      throw OutputError::of_system(path, fault);
    return;
  }
  const std::string place = end_of_links(path), part = place + kPartSuffix;
  unlink(part.c_str());  // of a killed process
  Descriptor file(part, O_CREAT | O_EXCL, kMode);
  int fault = file.number() < 0 ? errno : 0;
  if (fault == 0 && exists && fchmod(file.number(), there.st_mode & 07777) != 0) fault = errno;
  if (fault == 0) fault = file.write_all(text);
  if (fault == 0 && std::rename(part.c_str(), place.c_str()) != 0) fault = errno;
  if (fault == 0) return;
  unlink(part.c_str());
  throw OutputError::of_system(path, fault);
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
  if (error || !std::filesystem::is_directory(path, error))
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
