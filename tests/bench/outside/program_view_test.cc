#include "bench/outside/program_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>

namespace etude {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

class ProgramViewTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = ::testing::TempDir() + "program-view-XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    for (const char* file : {"mine/solver.py", "mine/own.bin", "other/weights.bin"}) {
      fs::create_directories((folder_ / file).parent_path());
      std::ofstream(folder_ / file) << "\n";
    }
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string In(const char* path) const { return (folder_ / path).string(); }

  fs::path folder_;
};

TEST_F(ProgramViewTest, ShowsTheScriptsFolderAndOtherFilesThatAreNamed) {
  const ProgramView view = ViewOf({"/bin/sh", In("mine/solver.py"), In("other/weights.bin"), "plain", "no/such"}, {});
  EXPECT_THAT(view.shown, ElementsAre(In("mine"), In("other/weights.bin")));
  EXPECT_EQ(view.start, In("mine"));
  EXPECT_THAT(view.command, ElementsAre("/bin/sh", In("mine/solver.py"), In("other/weights.bin"), "plain", "no/such"));
}

TEST_F(ProgramViewTest, ShowsTheExecutablesFolderFirst) {
  EXPECT_THAT(ViewOf({In("mine/own.bin"), In("other/weights.bin")}, {}).shown,
              ElementsAre(In("mine"), In("other/weights.bin")));
}

TEST_F(ProgramViewTest, ShowsWhatFilesListAndOfTheCommandTheFilesAlone) {
  const ProgramView view = ViewOf({"/bin/sh", In("mine/solver.py")}, {In("other/"), In("mine/own.bin")});
  EXPECT_THAT(view.shown, ElementsAre(In("other"), In("mine/own.bin"), In("mine/solver.py")));
  EXPECT_EQ(view.start, In("other"));
}

TEST_F(ProgramViewTest, ShowsALinkWithTheFolderThatItLiesInAndNotOnceMore) {
  fs::create_symlink("/bin/sh", In("mine/python"));
  EXPECT_THAT(ViewOf({In("mine/python"), In("other/weights.bin")}, {In("mine")}).shown,
              ElementsAre(In("mine"), In("other/weights.bin")));
}

TEST_F(ProgramViewTest, FindsWhatAFenceDoesNotShowAProgramThatDidNotStart) {
  const auto write = [&](const char* name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  };
  // A script names the program that it starts. Files that do not exist, or are visible, are not reported.
  write("manager/libexec/run", "#!/bin/sh\n");
  write("manager/shims/python", "#!/usr/bin/env bash\nexec \"" + In("manager/libexec/run") + "\" /no/such/file\n");
  const ProgramView shim = ViewOf({In("manager/shims/python"), In("mine/solver.py")}, {});
  EXPECT_THAT(FindUnseen(shim, ""), ElementsAre(In("manager")));
  EXPECT_EQ(FilesThatShow({In("manager")}, shim), "files: [" + In("mine") + ", " + In("manager") + "]");
  EXPECT_EQ(FilesThatShow({In("manager")}, shim, true), "--files " + In("mine") + " --files " + In("manager"));
  // The last words on stderr name the missing file.
  const ProgramView plain = ViewOf({"/bin/sh", In("mine/solver.py")}, {});
  EXPECT_THAT(FindUnseen(plain, ""), ElementsAre());
  EXPECT_THAT(FindUnseen(plain, "No such file: '" + In("other/weights.bin") + "'"), ElementsAre(In("other")));
  EXPECT_THAT(FindUnseen(plain, "cannot read " + In("mine/own.bin") + ", /usr/bin/env, / and /tmp"), ElementsAre());
  // The Python of a virtual environment is a link to a file outside the environment.
  write("python3.11/bin/python3", "");
  write("venv/pyvenv.cfg", "");
  fs::create_directories(folder_ / "venv/bin");
  fs::create_symlink(In("python3.11/bin/python3"), In("venv/bin/python"));
  EXPECT_THAT(FindUnseen(ViewOf({In("venv/bin/python"), In("mine/solver.py")}, {}), ""),
              ElementsAre(In("venv"), In("python3.11")));
}

TEST_F(ProgramViewTest, FindsThePythonPackageOfTheTree) { EXPECT_EQ(PythonFolder(), fs::current_path() / "python"); }

TEST_F(ProgramViewTest, NamesFilesOfOursByAbsolutePathsAndNoPlainWords) {
  // Tests run in the top folder of the source tree.
  const fs::path here = fs::current_path();
  const ProgramView view = ViewOf({"/bin/sh", "README.md", "tests", "./tests"}, {});
  EXPECT_THAT(view.command, ElementsAre("/bin/sh", (here / "README.md").string(), "tests", (here / "tests").string()));
  EXPECT_EQ(view.start, here);
  EXPECT_EQ(ViewOf({"/bin/sh"}, {}).start, "");
}

}  // namespace
}  // namespace etude
