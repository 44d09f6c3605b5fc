#include "bench/files/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/files/temporary_folder.h"

namespace etude {
namespace {

using testing::HasSubstr;

TEST(Files, ReadBackWhatTheyWroteAndLeaveNothingBeside) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "etude files";
  ASSERT_TRUE(WriteFileAtomically(folder / "a.txt", "bytes"));
  EXPECT_EQ(ReadWholeFile(folder / "a.txt"), "bytes");
  EXPECT_FALSE(std::filesystem::exists(TemporaryName(folder / "a.txt")));
  std::filesystem::remove_all(folder);
}

TEST(Files, OfAPlainNameAreWrittenWhereWeStand) {
  const std::filesystem::path before = std::filesystem::current_path();
  const auto folder = TemporaryFolder::Make("files-test");
  ASSERT_TRUE(folder);
  std::filesystem::current_path(folder->path());
  const auto written = WriteFileAtomically("plain.txt", "bytes");
  std::filesystem::current_path(before);
  EXPECT_TRUE(written);
  EXPECT_EQ(ReadWholeFile(folder->path() / "plain.txt"), "bytes");
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
  EXPECT_THAT(ToString(ReadWholeFile("/tmp").error()), HasSubstr("/tmp: is no file"));
  EXPECT_THAT(ToString(WriteFileAtomically("/dev/null/x", "").error()), HasSubstr("Not a directory"));
}

}  // namespace
}  // namespace etude
