#include "io/files/file_path.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// A folder filled by a stranger, and beside it a file of ours that the stranger wants.
class FilesInside : public ::testing::Test {
 protected:
  FilesInside() : scratch_(*TemporaryFolder::Make("inside-test")) {
    fs::create_directories(theirs_ / "report");
    fs::create_directories(ours_);
    std::ofstream(ours_ / "key") << "secret";
  }

  std::string Ours() { return *ReadWholeFile(ours_ / "key"); }
  std::size_t CountOurs() { return static_cast<std::size_t>(std::distance(fs::directory_iterator(ours_), {})); }

  TemporaryFolder scratch_;
  const fs::path theirs_ = scratch_.path() / "run", ours_ = scratch_.path() / "home";
};

TEST_F(FilesInside, AreWrittenAndReadLikeAnyOthers) {
  const FilePath path = Inside(theirs_) / "report" / "tables" / "a.csv";
  EXPECT_FALSE(Exists(path));
  ASSERT_TRUE(WriteFileAtomically(path, "1,2\n"));
  EXPECT_TRUE(Exists(path));
  EXPECT_EQ(ReadWholeFile(path), "1,2\n");
  EXPECT_EQ(ReadWholeFile(theirs_ / "report/tables/a.csv"), "1,2\n");
  EXPECT_THAT(*PlainFilesBelow(Inside(theirs_)), ElementsAre("report/tables/a.csv"));
  EXPECT_THAT(ToString(ReadWholeFile(Inside(theirs_) / "none").error()), HasSubstr("run/none: no such file"));
  EXPECT_TRUE(PlainFilesBelow(Inside(theirs_) / "none")->empty());
}

TEST_F(FilesInside, OfAFolderThatIsALinkItselfAreThoseOfTheFolderItNames) {
  fs::create_directory_symlink(theirs_, scratch_.path() / "link");
  ASSERT_TRUE(WriteFileAtomically(Inside(scratch_.path() / "link") / "a", "bytes"));
  EXPECT_EQ(ReadWholeFile(theirs_ / "a"), "bytes");
}

TEST_F(FilesInside, AreNotReadThroughALink) {
  fs::create_symlink(ours_ / "key", theirs_ / "cells.jsonl");
  fs::create_directory_symlink(ours_, theirs_ / "recordings");
  fs::create_symlink(ours_ / "none", theirs_ / "dangling");
  for (const FilePath& path :
       {Inside(theirs_) / "cells.jsonl", Inside(theirs_) / "recordings" / "key", Inside(theirs_) / "dangling"}) {
    EXPECT_TRUE(Exists(path)) << path.string();
    EXPECT_THAT(ToString(ReadWholeFile(path).error()), HasSubstr("is a link")) << path.string();
    EXPECT_FALSE(ReadInChunks(path, [](std::string_view) { FAIL(); }));
    EXPECT_FALSE(ForEachLine(path, [](std::string_view, const Place&) -> Result<void> { return Fail({}, "read"); }));
  }
  EXPECT_THAT(ToString(ReadWholeFile(Inside(theirs_) / "recordings" / "key").error()),
              HasSubstr("recordings: this is a link"));
  EXPECT_THAT(ToString(PlainFilesBelow(Inside(theirs_)).error()), HasSubstr("is a link"));
  EXPECT_EQ(ReadWholeFile(theirs_ / "cells.jsonl"), "secret") << "a path that a person gave is followed";
}

TEST_F(FilesInside, AreNotWrittenThroughALinkedFolder) {
  fs::remove(theirs_ / "report");
  fs::create_directory_symlink(ours_, theirs_ / "report");
  for (const char* name : {"a", "tables/a", "key"}) {
    const auto written = WriteFileAtomically(Inside(theirs_) / "report" / name, "theirs");
    EXPECT_THAT(ToString(written.error()), HasSubstr("report: this is a link")) << name;
  }
  EXPECT_FALSE(MakeFolder(Inside(theirs_) / "report" / "tables"));
  EXPECT_FALSE(OpenFile(Inside(theirs_) / "report" / "b", O_WRONLY | O_CREAT | O_APPEND));
  EXPECT_EQ(CountOurs(), 1u);
  EXPECT_EQ(Ours(), "secret");
}

TEST_F(FilesInside, ReplaceALinkAndLeaveWhatItNames) {
  fs::create_symlink(ours_ / "key", theirs_ / "report/index.html");
  ASSERT_TRUE(WriteFileAtomically(Inside(theirs_) / "report" / "index.html", "page"));
  EXPECT_EQ(ReadWholeFile(Inside(theirs_) / "report" / "index.html"), "page");
  EXPECT_EQ(Ours(), "secret");
  EXPECT_FALSE(OpenFile(Inside(theirs_) / "report" / "index.html", O_WRONLY | O_CREAT | O_EXCL)) << "it is a file now";
}

TEST_F(FilesInside, AreNotWrittenFirstIntoAnothersFile) {
  const FilePath path = Inside(theirs_) / "report" / "index.html";
  const fs::path partial = TemporaryName(path.whole());
  fs::create_symlink(ours_ / "key", partial);
  EXPECT_THAT(ToString(WriteFileAtomically(path, "page").error()), HasSubstr("index.partial.html: this is a link"));
  fs::remove(partial);
  fs::create_hard_link(ours_ / "key", partial);
  ASSERT_TRUE(WriteFileAtomically(path, "page")) << "under the next name";
  EXPECT_EQ(ReadWholeFile(path), "page");
  EXPECT_EQ(Ours(), "secret");
}

TEST_F(FilesInside, ThatHaveAnotherNameAreReadAndNotWritten) {
  fs::create_hard_link(ours_ / "key", theirs_ / "journal");
  for (const int flags : {O_WRONLY | O_APPEND, O_WRONLY | O_CREAT | O_TRUNC, O_RDWR}) {
    EXPECT_THAT(testing::Refusal(OpenFile(Inside(theirs_) / "journal", flags)),
                HasSubstr("run/journal: the file has a second name (a hard link)"));
  }
  EXPECT_EQ(Ours(), "secret");
  EXPECT_EQ(ReadWholeFile(Inside(theirs_) / "journal"), "secret");
  EXPECT_TRUE(OpenFile(theirs_ / "journal", O_WRONLY)) << "a path that a person gave";
}

TEST_F(FilesInside, HaveNoNamesThatLeadOutOfTheirFolder) {
  for (const fs::path& name :
       {fs::path("../home/key"), fs::path("report/../../home/key"), ours_ / "key", fs::path("..")}) {
    const FilePath path = Inside(theirs_) / name;
    EXPECT_FALSE(ReadWholeFile(path)) << name;
    EXPECT_FALSE(WriteFileAtomically(path, "theirs")) << name;
  }
  EXPECT_THAT(ToString(ReadWholeFile(Inside(theirs_) / "../home/key").error()), HasSubstr("leads out of"));
  EXPECT_EQ(Ours(), "secret");
}

TEST_F(FilesInside, ThatArePipesAreNotWaitedFor) {
  ASSERT_EQ(::mkfifo((theirs_ / "manifest.json").c_str(), 0600), 0);
  for (const FilePath& path : {Inside(theirs_) / "manifest.json", FilePath(theirs_ / "manifest.json")}) {
    EXPECT_THAT(ToString(ReadWholeFile(path).error()), HasSubstr("is no file"));
    EXPECT_THAT(ToString(OpenFile(path, O_WRONLY | O_APPEND).error()), HasSubstr("is no file"));
  }
  EXPECT_THAT(ToString(PlainFilesBelow(Inside(theirs_)).error()), HasSubstr("this is neither a file nor a folder"));
}

TEST(FileLines, AreThoseOfTheFileHoweverItIsCutIntoParts) {
  const auto folder = TemporaryFolder::Make("files-test");
  const fs::path path = folder->path() / "lines";
  const std::vector<std::string> lines = {"", "a", std::string(200'000, 'b'), "", std::string((1 << 16) - 1, 'c'), "d"};
  for (const bool ends : {true, false}) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    if (!ends) text.pop_back();
    ASSERT_TRUE(WriteFileAtomically(path, text));
    auto file = FileLines::Open(path);
    std::string line;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      ASSERT_EQ(file->Next(line), true);
      EXPECT_EQ(line, lines[i]);
      EXPECT_EQ(file->had_end(), ends || i + 1 < lines.size());
    }
    EXPECT_EQ(file->Next(line), false);
  }
}

TEST(IsWithin, ComparesWholeNames) {
  EXPECT_TRUE(IsWithin("/a/b", "/a/b"));
  EXPECT_TRUE(IsWithin("/a/b/c", "/a/b"));
  EXPECT_FALSE(IsWithin("/a", "/a/b"));
  EXPECT_FALSE(IsWithin("/a/bc", "/a/b")) << "b is only the beginning of a name";
}

}  // namespace
}  // namespace etude
