#include "io/process/loaded_libraries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>

namespace etude {
namespace {

using ::testing::Contains;
using ::testing::Key;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

TEST(LoadedLibraries, NamesEachByItsBuild) {
  const auto libraries = LoadedLibraries();
  EXPECT_THAT(libraries, Contains(Key("libc.so.6")));
  EXPECT_THAT(libraries, Not(Contains(Key(StartsWith("linux-vdso")))));
  for (const auto& [name, build] : libraries) EXPECT_THAT(build, MatchesRegex("([0-9a-f]{40})?")) << name;
}

// A second reader finds the build ID in the bytes of the file that our memory map names.
TEST(LoadedLibraries, HasTheBuildIdThatStandsInTheFile) {
  std::ifstream maps("/proc/self/maps");
  std::string path;
  for (std::string line; path.empty() && std::getline(maps, line);) {
    if (line.ends_with("/libc.so.6")) path = line.substr(line.find('/'));
  }
  std::ifstream file(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  const std::size_t note = bytes.find(std::string("\x14\0\0\0\x03\0\0\0GNU\0", 12));
  ASSERT_NE(note, std::string::npos);
  std::string hex;
  for (const unsigned char byte : bytes.substr(note + 12, 20)) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", byte);
    hex += digits;
  }
  EXPECT_THAT(LoadedLibraries(), Contains(std::pair<std::string, std::string>("libc.so.6", hex)));
}

}  // namespace
}  // namespace etude
