// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "encase/result.hpp"

namespace encase {

/// Writes a file that is complete or absent: the contents go to a temporary name in the same
/// directory, which is renamed to `path` at the end. What stood there before survives any failure.
/// A symbolic link is followed; a device or pipe is written directly. Io with a sentence that names
/// the path: a directory, a missing parent, no permission, no space.
Status write_file(const std::string& path, std::string_view contents);

/// Removes the temporary files and directories of what is being written, in any thread. What is at
/// work on them then waits for ever: the caller is about to end the process.
void abandon_writes();

/// A directory of files that are written under a temporary name beside their final place and appear
/// there when all are complete. The temporary is removed by the destructor.
class AtomicDirectory {
 public:
  /// `path` names the directory to be; its parent must exist. Io if it cannot be made.
  static Result<AtomicDirectory> create(const std::string& path);

  AtomicDirectory(AtomicDirectory&& other) noexcept;
  AtomicDirectory& operator=(AtomicDirectory&&) = delete;
  ~AtomicDirectory();

  /// Where to write until `commit`.
  const std::string& temporary() const { return temporary_; }

  /// Puts the directory in its place. If one stands there the files go into it, each replacing one
  /// of its name; other files there are left alone.
  Status commit();

 private:
  AtomicDirectory(std::string path, std::string temporary);

  std::string path_;
  std::string temporary_;  // empty: nothing to remove
};

}  // namespace encase
