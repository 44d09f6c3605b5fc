#include "bench/run/run_folder.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/results/seal.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "tests/support/results.h"

namespace etude {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

/// A folder "out" with the files of a run that RunFolder looks at.
class RunFolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(WriteFileAtomically(out_ / "host.json", "old"));
    ASSERT_TRUE(WriteFileAtomically(out_ / "report" / "index.html", "old"));
  }

  static std::vector<std::string> NamesIn(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
    return names;
  }

  void ExpectOldRun() const {
    EXPECT_THAT(NamesIn(out_), UnorderedElementsAre("host.json", "report"));
    EXPECT_EQ(ReadWholeFile(out_ / "report" / "index.html"), "old");
  }

  const TemporaryFolder folder_ = *TemporaryFolder::Make("run-folder-test");
  const fs::path out_ = folder_.path() / "out";
};

TEST_F(RunFolderTest, GivesAnEmptyLockedFolderForTheOldRunWhichGoesWhenThereIsSomethingToKeep) {
  {
    auto claimed = RunFolder::Claim(out_, /*keep_contents=*/false);
    ASSERT_TRUE(claimed);
    EXPECT_THAT(NamesIn(out_), ElementsAre(kLockFile));
    EXPECT_FALSE(RunFolder::Claim(out_, false)) << "it is locked";
    claimed->Keep();
    EXPECT_THAT(NamesIn(folder_.path()), ElementsAre("out"));
  }
  EXPECT_THAT(NamesIn(out_), IsEmpty());
}

TEST_F(RunFolderTest, PutsTheOldRunBackWhenNothingIsKept) {
  {
    ASSERT_OK(claimed, RunFolder::Claim(out_, false));
    ASSERT_TRUE(WriteFileAtomically(out_ / "manifest.json", "new"));
  }
  ExpectOldRun();
  EXPECT_THAT(NamesIn(folder_.path()), ElementsAre("out"));
}

/// Overwrites the run in a process that is killed before it ends.
void OverwriteAndDie(const fs::path& out) {
  const pid_t child = ::fork();
  if (child == 0) {
    auto claimed = RunFolder::Claim(out, false);
    const bool is_written = claimed && WriteFileAtomically(out / "manifest.json", "new").has_value();
    ::kill(::getpid(), is_written ? SIGKILL : SIGABRT);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_EQ(WTERMSIG(status), SIGKILL);
}

TEST_F(RunFolderTest, PutsTheOldRunBackThatAKilledOverwritingLeftWhenTheNextOneFails) {
  OverwriteAndDie(out_);
  ASSERT_TRUE(fs::exists(out_ / "manifest.json"));
  TemporaryFolder::RemoveAbandoned(folder_.path());  // another process's clean-up of abandoned folders
  {
    ASSERT_OK(claimed, RunFolder::Claim(out_, false));
    EXPECT_THAT(NamesIn(out_), ElementsAre(kLockFile));
  }
  ExpectOldRun();
  EXPECT_THAT(NamesIn(folder_.path()), ElementsAre("out"));
}

TEST_F(RunFolderTest, DropsTheOldRunThatAKilledOverwritingLeftWhenTheNextOneKeepsSomething) {
  OverwriteAndDie(out_);
  {
    auto claimed = RunFolder::Claim(out_, false);
    ASSERT_TRUE(claimed);
    ASSERT_TRUE(WriteFileAtomically(out_ / "host.json", "new"));
    claimed->Keep();
  }
  EXPECT_EQ(ReadWholeFile(out_ / "host.json"), "new");
  EXPECT_THAT(NamesIn(folder_.path()), ElementsAre("out"));
}

TEST_F(RunFolderTest, LeavesToAReaderTheFilesThatItHasOpened) {
  const int reader = ::open((out_ / "host.json").c_str(), O_RDONLY | O_CLOEXEC);
  auto claimed = RunFolder::Claim(out_, false);
  ASSERT_TRUE(claimed);
  claimed->Keep();
  char text[4] = {};
  EXPECT_EQ(::read(reader, text, 3), 3);
  EXPECT_STREQ(text, "old");
  ::close(reader);
}

TEST_F(RunFolderTest, KeepsALinkToTheFolderALink) {
  const fs::path link = folder_.path() / "link";
  fs::create_directory_symlink(out_, link);
  auto claimed = RunFolder::Claim(link, false);
  ASSERT_TRUE(claimed);
  claimed->Keep();
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_THAT(NamesIn(out_), ElementsAre(kLockFile));
}

TEST_F(RunFolderTest, EmptiesTheWorkingFolderInItsPlace) {
  const fs::path before = fs::current_path();
  fs::current_path(out_);
  EXPECT_TRUE(RunFolder::Claim(".", false)) << "and what it made is gone again";
  fs::current_path(before);
  EXPECT_THAT(NamesIn(out_), IsEmpty());
  EXPECT_THAT(NamesIn(folder_.path()), ElementsAre("out"));
}

TEST_F(RunFolderTest, LeavesAFolderThatAnotherRunWritesIntoAsItIs) {
  ASSERT_OK(other, RunFolder::Claim(out_, /*keep_contents=*/true));
  EXPECT_THAT(testing::Refusal(RunFolder::Claim(out_, false)), ::testing::HasSubstr("another run is writing into this "
                                                                                    "folder"));
  EXPECT_EQ(ReadWholeFile(out_ / "host.json"), "old");
}

}  // namespace
}  // namespace etude
