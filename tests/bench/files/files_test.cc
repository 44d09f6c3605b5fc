#include "bench/files/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(Files, SayWhyTheyCannotBeReadOrWritten) {
  EXPECT_THAT(ToString(ReadWholeFile("/no/such/file").error()), HasSubstr("/no/such/file: no such file"));
  EXPECT_THAT(ToString(ReadWholeFile("/tmp").error()), HasSubstr("/tmp: is no file"));
  EXPECT_THAT(ToString(WriteFileAtomically("/dev/null/x", "").error()), HasSubstr("Not a directory"));
}

}  // namespace
}  // namespace etude
