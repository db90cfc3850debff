// SPDX-License-Identifier: MIT
#include "output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "encase/atomic_file.hpp"

namespace encase {
namespace {

Error io_error(const std::string& message) { return {Error::Code::Io, message}; }

std::string reason(int code) { return std::strerror(code); }

}  // namespace

ExitCode fail(const Error& error) {
  std::fflush(stdout);
  std::fprintf(stderr, "encase: %s\n", error.message.c_str());
  return exit_code(error.code);
}

Status print(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    return io_error("cannot write to standard output: " + reason(errno));
  return {};
}

Status write_output(const std::string& path, const std::string& text) {
  return path == "-" ? print(text) : write_file(path, text);
}

Status check_writable(const std::string& path) {
  if (path.empty() || path == "-") return {};
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    return io_error("cannot write " + path + ": it is a directory");
  fs::path parent = fs::path(path).parent_path();
  if (parent.empty()) parent = ".";
  if (!fs::is_directory(parent, ignored))
    return io_error("cannot write " + path + ": there is no directory " + parent.string());
  if (fs::exists(path, ignored) ? access(path.c_str(), W_OK) != 0
                                : access(parent.c_str(), W_OK | X_OK) != 0)
    return io_error("cannot write " + path + ": " + reason(errno));
  return {};
}

Status check_writable_directory(const std::string& path) {
  if (path.empty()) return {};
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    if (access(path.c_str(), W_OK | X_OK) != 0)
      return io_error("cannot write in " + path + ": " + reason(errno));
    return {};
  }
  if (fs::exists(path, ignored))
    return io_error("cannot make the directory " + path + ": a file of that name exists");
  fs::path parent = fs::absolute(path, ignored).lexically_normal();
  if (!parent.has_filename()) parent = parent.parent_path();
  parent = parent.parent_path();
  if (!fs::is_directory(parent, ignored))
    return io_error("cannot make the directory " + path + ": there is no directory " +
                    parent.string());
  if (access(parent.c_str(), W_OK | X_OK) != 0)
    return io_error("cannot make the directory " + path + ": " + reason(errno));
  return {};
}

Result<std::string> read_input(const std::string& path) {
  const bool standard = path == "-";
  const std::string shown = standard ? "standard input" : path;
  std::error_code ignored;
  if (!standard && std::filesystem::is_directory(path, ignored))
    return io_error("cannot read " + shown + ": it is a directory");
  std::FILE* file = standard ? stdin : std::fopen(path.c_str(), "rb");
  if (!file) return io_error("cannot read " + shown + ": " + reason(errno));
  std::string text;
  char buffer[1 << 16];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, file)) text.append(buffer, n);
  const bool failed = std::ferror(file);
  const int code = errno;
  if (!standard) std::fclose(file);
  if (failed) return io_error("cannot read " + shown + ": " + reason(code));
  return text;
}

}  // namespace encase
