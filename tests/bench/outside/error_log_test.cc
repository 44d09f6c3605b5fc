#include <gtest/gtest.h>
#include <sys/stat.h>

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

}  // namespace
}  // namespace etude
