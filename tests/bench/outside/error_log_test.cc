#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "bench/outside/watched_program.h"

namespace etude {
namespace {

TEST(ErrorLog, TrimmingGivesMemoryBackAndLosesNothingSaidMeanwhile) {
  ErrorLog log(::testing::TempDir() + "error-log-test.txt");
  std::ofstream program(log.path(), std::ios::app);
  for (int i = 0; i < 5; ++i) {
    program << std::string(1 << 20, 'x') << '\n' << std::flush;
    log.Trim();
  }
  program << "the last words\n" << std::flush;
  struct stat status {};
  ASSERT_EQ(::stat(log.path().c_str(), &status), 0);
  EXPECT_GT(status.st_size, 5L << 20);
  EXPECT_LT(status.st_blocks * 512, ErrorLog::kMaxBytes + (1 << 20) + (64 << 10));
  log.Trim();
  EXPECT_EQ(log.LastLine(), "the last words");
}

TEST(ErrorLog, TheLastLineIsTheNewestOneHoweverMuchWasWrittenBefore) {
  ErrorLog log(::testing::TempDir() + "error-log-test.txt");
  std::ofstream program(log.path(), std::ios::app);
  program << "an old line\n" << std::flush;
  // Three times beyond the size at which the file is truncated. The holes of the file take no memory.
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(::truncate(log.path().c_str(), 200L << 20), 0);
    const std::string last = "line " + std::to_string(i);
    program << '\n' << last << '\n' << std::flush;
    log.Trim();
    struct stat status {};
    ASSERT_EQ(::stat(log.path().c_str(), &status), 0);
    EXPECT_EQ(status.st_size, ErrorLog::kMaxBytes);
    EXPECT_EQ(log.LastLine(), last) << "nothing was written since the file was truncated";
    program << "half of " << std::flush;
    EXPECT_EQ(log.LastLine(), "half of");
    program << "a line\n" << std::flush;
    log.Trim();
    EXPECT_EQ(log.LastLine(), "half of a line");
  }
  log.Save();
  EXPECT_EQ(log.LastLine(), "");
}

}  // namespace
}  // namespace etude
