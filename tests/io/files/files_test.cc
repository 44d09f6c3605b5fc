#include "io/files/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "io/files/temporary_folder.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

TEST(Files, ReadBackWhatTheyWroteAndLeaveNothingBeside) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "etude files";
  ASSERT_TRUE(WriteFileAtomically(folder / "a.txt", "bytes"));
  EXPECT_EQ(ReadWholeFile(folder / "a.txt"), "bytes");
  EXPECT_FALSE(std::filesystem::exists(TemporaryName(folder / "a.txt")));
  std::filesystem::remove_all(folder);
}

TEST(Files, WrittenByTwoAtOnceAreEachWhole) {
  const auto folder = TemporaryFolder::Make("files-test");
  const fs::path path = folder->path() / "a.json";
  auto first = AtomicFile::Begin(path), second = AtomicFile::Begin(path);
  ASSERT_TRUE(first && second);
  ASSERT_TRUE(first->Write("first") && second->Write("second"));
  ASSERT_TRUE(first->Finish());
  EXPECT_EQ(ReadWholeFile(path), "first");
  ASSERT_TRUE(second->Finish());
  EXPECT_EQ(ReadWholeFile(path), "second");
  { EXPECT_TRUE(AtomicFile::Begin(path)); }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder->path()), {}), 1) << "nothing is left beside it";
}

TEST(Files, TakeTheNameThatAKilledWriterHasLeft) {
  const auto folder = TemporaryFolder::Make("files-test");
  const fs::path path = folder->path() / "a.json";
  std::ofstream(TemporaryName(path)) << "half of much more than comes now";
  ASSERT_TRUE(WriteFileAtomically(path, "whole"));
  EXPECT_EQ(ReadWholeFile(path), "whole");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder->path()), {}), 1);
}

TEST(Files, OfAPlainNameAreWrittenWhereWeStand) {
  const std::filesystem::path before = std::filesystem::current_path();
  ASSERT_OK(folder, TemporaryFolder::Make("files-test"));
  std::filesystem::current_path(folder->path());
  const auto written = WriteFileAtomically("plain.txt", "bytes");
  std::filesystem::current_path(before);
  EXPECT_TRUE(written);
  EXPECT_EQ(ReadWholeFile(folder->path() / "plain.txt"), "bytes");
}

TEST(TemporaryFolders, OfAKilledProcessGoWithTheNextOneOfALivingOneStay) {
  int report[2];
  ASSERT_EQ(::pipe(report), 0);
  const pid_t other = ::fork();
  if (other == 0) {
    const auto folder = TemporaryFolder::Make("files-test");
    std::ofstream(folder->path() / "a") << "text";
    const std::string name = folder->path().string();
    if (::write(report[1], name.data(), name.size()) < 0) ::_exit(1);
    ::pause();
  }
  char name[4096] = {};
  ASSERT_GT(::read(report[0], name, sizeof name - 1), 0);
  ::close(report[0]);
  ::close(report[1]);
  const auto mine = TemporaryFolder::Make("files-test");
  EXPECT_TRUE(fs::exists(fs::path(name) / "a"));
  ::kill(other, SIGKILL);
  ::waitpid(other, nullptr, 0);
  EXPECT_TRUE(fs::exists(fs::path(name) / "a"));
  TemporaryFolder::RemoveAbandoned();
  EXPECT_FALSE(fs::exists(name));
  EXPECT_TRUE(fs::exists(mine->path()));
}

TEST(TemporaryFolders, AreToldFromFoldersOfPeopleByTheirName) {
  const fs::path folder = fs::temp_directory_path() / "etude-results-of-the-files-test";
  fs::create_directories(folder);
  TemporaryFolder::RemoveAbandoned();
  EXPECT_TRUE(fs::exists(folder));
  fs::remove_all(folder);
}

TEST(TemporaryFolders, GoAwayWithAllThatIsInThem) {
  std::filesystem::path path;
  {
    auto folder = TemporaryFolder::Make("files-test");
    ASSERT_TRUE(folder);
    const TemporaryFolder moved = std::move(*folder);
    path = moved.path();
    ASSERT_TRUE(WriteFileAtomically(path / "inner" / "a.txt", "bytes"));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Files, SayWhyTheyCannotBeReadOrWritten) {
  EXPECT_THAT(ToString(ReadWholeFile("/no/such/file").error()), HasSubstr("/no/such/file: no such file"));
  EXPECT_THAT(ToString(ReadWholeFile("/tmp").error()), HasSubstr("/tmp: is no file, but a folder; allowed: a file"));
  EXPECT_THAT(ToString(WriteFileAtomically("/dev/null/x", "").error()), HasSubstr("Not a directory"));
}

}  // namespace
}  // namespace etude
