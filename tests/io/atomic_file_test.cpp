// SPDX-License-Identifier: MIT
#include "encase/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace encase {
namespace {

namespace fs = std::filesystem;

class AtomicFile : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::path(testing::TempDir()) / ("encase-atomic-" + std::to_string(getpid()));
    fs::remove_all(directory_);
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  static std::string read(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  int entries() const {
    return static_cast<int>(
        std::distance(fs::directory_iterator(directory_), fs::directory_iterator{}));
  }

  fs::path directory_;
};

TEST_F(AtomicFile, WritesEveryByteAndLeavesNothingElse) {
  std::string contents("a\0b\r\n", 5);
  contents.append(1 << 20, 'x');
  ASSERT_FALSE(write_file(path("f"), contents));
  EXPECT_EQ(read(path("f")), contents);
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFile, ReplacesAFileAndKeepsItsMode) {
  ASSERT_FALSE(write_file(path("f"), "old and longer"));
  ASSERT_EQ(chmod(path("f").c_str(), 0640), 0);
  ASSERT_FALSE(write_file(path("f"), "new"));
  EXPECT_EQ(read(path("f")), "new");
  struct stat status;
  ASSERT_EQ(stat(path("f").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640u);
}

TEST_F(AtomicFile, FollowsASymbolicLink) {
  ASSERT_FALSE(write_file(path("f"), "old"));
  fs::create_symlink(path("f"), path("link"));
  ASSERT_FALSE(write_file(path("link"), "new"));
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read(path("f")), "new");
}

TEST_F(AtomicFile, WritesADeviceWithoutReplacingIt) {
  ASSERT_FALSE(write_file("/dev/null", "gone"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(AtomicFile, RefusesADirectoryWithAClearMessage) {
  const Status status = write_file(directory_.string(), "x");
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, Error::Code::Io);
  EXPECT_EQ(status->message, "cannot write '" + directory_.string() + "': it is a directory");
}

TEST_F(AtomicFile, NamesTheMissingParent) {
  const Status status = write_file(path("no/f"), "x");
  ASSERT_TRUE(status);
  EXPECT_EQ(status->message, "cannot write '" + path("no/f") + "': the directory '" + path("no") +
                                 "' does not exist");
}

TEST_F(AtomicFile, RefusesAFileAsParentAndEmptyNames) {
  ASSERT_FALSE(write_file(path("f"), "x"));
  EXPECT_TRUE(write_file(path("f") + "/g", "x"));
  EXPECT_TRUE(write_file("", "x"));
  EXPECT_TRUE(write_file(path("new/"), "x"));
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFile, ReportsAFailedWriteAndRemovesTheTemporary) {
  const Status full = write_file("/dev/full", "x");
  ASSERT_TRUE(full);
  EXPECT_EQ(full->message, "cannot write '/dev/full': No space left on device");
  // The system refuses names above 255 bytes, after the temporary was written.
  EXPECT_TRUE(write_file(path(std::string(300, 'n')), "x"));
  EXPECT_EQ(entries(), 0);
}

TEST_F(AtomicFile, ReportsMissingPermission) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::permissions(directory_, fs::perms::owner_read | fs::perms::owner_exec);
  const Status status = write_file(path("f"), "x");
  fs::permissions(directory_, fs::perms::owner_all);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->message, "cannot write '" + path("f") + "': Permission denied");
}

using AtomicDirectoryTest = AtomicFile;

TEST_F(AtomicDirectoryTest, AppearsWhenCommitted) {
  {
    auto made = AtomicDirectory::create(path("d"));
    ASSERT_TRUE(made.ok());
    AtomicDirectory directory = std::move(made).value();
    ASSERT_FALSE(write_file(directory.temporary() + "/f", "x"));
    EXPECT_FALSE(fs::exists(path("d")));
    ASSERT_FALSE(directory.commit());
  }
  EXPECT_EQ(read(path("d/f")), "x");
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicDirectoryTest, ReplacesFilesOfItsOwnAndLeavesOthersAlone) {
  fs::create_directory(path("d"));
  ASSERT_FALSE(write_file(path("d/other"), "x"));
  ASSERT_FALSE(write_file(path("d/new"), "old"));
  {
    auto directory = AtomicDirectory::create(path("d"));
    ASSERT_TRUE(directory.ok());
    ASSERT_FALSE(write_file(directory.value().temporary() + "/new", "new"));
    ASSERT_FALSE(directory.value().commit());
  }
  EXPECT_EQ(read(path("d/new")), "new");
  EXPECT_EQ(read(path("d/other")), "x");
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicDirectoryTest, LeavesNothingWithoutCommit) {
  { auto directory = AtomicDirectory::create(path("d")); }
  EXPECT_EQ(entries(), 0);
  EXPECT_FALSE(AtomicDirectory::create(path("no/d")).ok());
  ASSERT_FALSE(write_file(path("f"), "x"));
  EXPECT_FALSE(AtomicDirectory::create(path("f")).ok());
}

TEST_F(AtomicDirectoryTest, LeavesNothingThatIsAbandoned) {
  const auto end = [&] {
    auto directory = AtomicDirectory::create(path("d"));
    const bool written =
        directory.ok() && !write_file(directory.value().temporary() + "/f", "x") && entries() == 1;
    abandon_writes();
    _exit(written ? 7 : 8);
  };
  EXPECT_EXIT(end(), testing::ExitedWithCode(7), "");
  EXPECT_EQ(entries(), 0);
}

}  // namespace
}  // namespace encase
