// SPDX-License-Identifier: MIT
#include "encase/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

namespace encase {
namespace {

namespace fs = std::filesystem;

Error cannot_write(const std::string& path, const std::string& why) {
  return {Error::Code::Io, "cannot write '" + path + "': " + why};
}

Error cannot_write(const std::string& path, int code) {
  return cannot_write(path, std::generic_category().message(code));
}

/// Held while a temporary appears, or is put in its place or removed.
std::mutex temporaries_mutex;

/// Those that exist.
std::set<std::string>& temporaries() {
  static std::set<std::string> paths;
  return paths;
}

// A new temporary file or directory, as `make` says, which returns a negative number where it fails
// and sets errno. Its name is short whatever the target's is, so that a name the file system
// accepts never fails here.
template <class Make>
int make_temporary(const fs::path& directory, std::string* path, Make make) {
  static std::atomic<unsigned> count{0};
  const std::string name =
      ".encase-" + std::to_string(getpid()) + "-" + std::to_string(count.fetch_add(1)) + ".tmp";
  *path = (directory / name).string();
  std::lock_guard lock(temporaries_mutex);
  const int result = make(path->c_str());
  if (result >= 0) temporaries().insert(*path);
  return result;
}

// `finish` puts a temporary in its place or removes it.
template <class Finish>
void finish_temporary(const std::string& path, Finish finish) {
  std::lock_guard lock(temporaries_mutex);
  finish();
  temporaries().erase(path);
}

// Why nothing can be put into a directory, if that can be told before trying.
Status check_parent(const std::string& path, const fs::path& parent) {
  std::error_code ignored;
  const fs::file_status status = fs::status(parent, ignored);
  if (!fs::exists(status))
    return cannot_write(path, "the directory '" + parent.string() + "' does not exist");
  if (!fs::is_directory(status))
    return cannot_write(path, "'" + parent.string() + "' is not a directory");
  return std::nullopt;
}

fs::path parent_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// 0, or the errno of the write that failed.
int write_all(int file, std::string_view contents) {
  while (!contents.empty()) {
    const ssize_t written = write(file, contents.data(), contents.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

// 0, or an errno. Some file systems report a full disk only when the file is closed.
int write_and_close(int file, std::string_view contents) {
  const int failure = write_all(file, contents);
  const int close_failure = close(file) == 0 ? 0 : errno;
  return failure ? failure : close_failure;
}

}  // namespace

Status write_file(const std::string& path, std::string_view contents) {
  if (path.empty()) return cannot_write(path, "the file name is empty");
  struct stat existing;
  const bool exists = stat(path.c_str(), &existing) == 0;
  if (exists && S_ISDIR(existing.st_mode)) return cannot_write(path, "it is a directory");
  if (exists && !S_ISREG(existing.st_mode)) {
    // A device or a pipe: renaming onto it would put a plain file in its place.
    const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) return cannot_write(path, errno);
    const int failure = write_and_close(file, contents);
    if (failure) return cannot_write(path, failure);
    return std::nullopt;
  }
  if (exists && access(path.c_str(), W_OK) != 0) return cannot_write(path, errno);

  fs::path target = path;
  if (exists) {
    std::error_code failure;
    const fs::path resolved = fs::canonical(target, failure);
    if (!failure) target = resolved;
  }
  if (!target.has_filename()) return cannot_write(path, "the file name is empty");
  const fs::path parent = parent_of(target);
  if (Status bad = check_parent(path, parent)) return bad;

  std::string temporary;
  const int file = make_temporary(parent, &temporary, [](const char* name) {
    return open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  });
  if (file < 0) return cannot_write(path, errno);
  if (exists) static_cast<void>(fchmod(file, existing.st_mode & 07777));
  int failure = write_and_close(file, contents);
  finish_temporary(temporary, [&] {
    if (!failure && rename(temporary.c_str(), target.c_str()) != 0) failure = errno;
    if (failure) unlink(temporary.c_str());
  });
  if (failure) return cannot_write(path, failure);
  return std::nullopt;
}

void abandon_writes() {
  temporaries_mutex.lock();  // for ever
  std::error_code ignored;
  for (const std::string& path : temporaries())
    // (Another thread may be filling a directory.)
    for (int tries = 0; tries < 1000 && fs::exists(path, ignored); ++tries)
      fs::remove_all(path, ignored);
}

AtomicDirectory::AtomicDirectory(std::string path, std::string temporary)
    : path_(std::move(path)), temporary_(std::move(temporary)) {}

AtomicDirectory::AtomicDirectory(AtomicDirectory&& other) noexcept
    : path_(std::move(other.path_)), temporary_(std::exchange(other.temporary_, {})) {}

AtomicDirectory::~AtomicDirectory() {
  if (temporary_.empty()) return;
  finish_temporary(temporary_, [&] {
    std::error_code ignored;
    fs::remove_all(temporary_, ignored);
  });
}

Result<AtomicDirectory> AtomicDirectory::create(const std::string& path) {
  const fs::path target = path;
  if (!target.has_filename()) return cannot_write(path, "the directory's name is empty");
  std::error_code failure;
  const fs::file_status status = fs::status(target, failure);
  if (fs::exists(status) && !fs::is_directory(status))
    return cannot_write(path, "it is not a directory");
  const fs::path parent = parent_of(target);
  if (Status bad = check_parent(path, parent)) return *bad;
  std::string temporary;
  if (make_temporary(parent, &temporary, [](const char* name) { return mkdir(name, 0777); }) < 0)
    return cannot_write(path, errno);
  return AtomicDirectory(path, std::move(temporary));
}

Status AtomicDirectory::commit() {
  std::error_code failure;
  if (!fs::exists(path_, failure)) {
    finish_temporary(temporary_, [&] {
      fs::rename(temporary_, path_, failure);
      std::error_code ignored;
      if (failure) fs::remove_all(temporary_, ignored);
    });
    temporary_.clear();
  } else {
    std::lock_guard lock(temporaries_mutex);
    for (const fs::directory_entry& entry : fs::directory_iterator(temporary_, failure)) {
      fs::rename(entry.path(), fs::path(path_) / entry.path().filename(), failure);
      if (failure) break;
    }
  }
  if (failure) return cannot_write(path_, failure.message());
  return std::nullopt;
}

}  // namespace encase
