#include "io/files/own_files.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/files/temporary_folder.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

TEST(OwnFiles, ThisProgramIsTheProgramOfTheTest) {
  EXPECT_TRUE(ThisProgram().filename().string().starts_with("etude_tests_")) << ThisProgram();
}

TEST(OwnFiles, AreFoundAboveTheProgramInAnInstalledFolderBeforeACloneAroundIt) {
  const auto made = TemporaryFolder::Make("own");
  ASSERT_TRUE(made);
  const fs::path clone = made->path(), prefix = clone / "out/usr", program = prefix / "lib/x86_64-linux-gnu/etude";
  fs::create_directories(program);
  fs::create_directories(clone / "scenarios/quick");
  EXPECT_EQ(FolderWith("scenarios/quick", program), clone);
  fs::create_directories(prefix / "share/etude/scenarios/quick");
  EXPECT_EQ(FolderWith("scenarios/quick", program), prefix / "share/etude");
  fs::create_directories(clone / "share/etude/scenarios/quick");
  fs::remove_all(prefix / "share");
  EXPECT_EQ(FolderWith("scenarios/quick", program), clone / "share/etude");
  EXPECT_EQ(FolderWith("scenarios/slow", program), fs::path());
}

TEST(OwnFiles, MayBeAtTheRootOfTheFileSystem) { EXPECT_EQ(FolderWith("usr/lib", "/usr/lib/etude"), fs::path("/")); }

}  // namespace
}  // namespace etude
