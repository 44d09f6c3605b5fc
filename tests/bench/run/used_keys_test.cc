#include "bench/run/used_keys.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "io/files/files.h"
#include "io/files/temporary_folder.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class UsedKeysTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto made = TemporaryFolder::Make("used-keys-test");
    ASSERT_TRUE(made);
    folder_.emplace(std::move(*made));
    std::ofstream(File()) << "a key";
  }

  std::string File() const { return (folder_->path() / "key").string(); }
  std::string List() const { return File() + ".used"; }
  std::string Text() const { return *ReadWholeFile(List()); }
  SecretKey Key(std::uint64_t number = 1) const { return {{number, 2, 3, 4}, File()}; }
  KeyUse Use(const Shard& shard = {}, const std::string& manifest = "m") const {
    return {"run", "ik", manifest, shard, folder_->path() / ("out-" + std::to_string(shard.index))};
  }
  std::string Complaint(const SecretKey& key, const KeyUse& use) const {
    const auto checked = CheckUnused(key, use), noted = NoteUse(key, use, false);
    EXPECT_EQ(checked.has_value(), noted.has_value());
    return noted ? "" : ToString(noted.error());
  }

  std::optional<TemporaryFolder> folder_;
};

TEST_F(UsedKeysTest, ASecondUseIsRefusedWithTheFirst) {
  EXPECT_TRUE(CheckUnused(Key(), Use()));
  EXPECT_FALSE(std::filesystem::exists(List())) << "a check writes nothing";
  EXPECT_EQ(Complaint(Key(), Use()), "");
  const auto told = Complaint(Key(), Use({}, "another suite's"));
  EXPECT_THAT(told, HasSubstr(File() + ": was used before: 'etude run' with 'ik' wrote into " +
                              (folder_->path() / "out-1").string()));
  EXPECT_THAT(told, HasSubstr(List() + ":1"));
  EXPECT_THAT(told, HasSubstr("--reuse-key"));
  EXPECT_EQ(std::filesystem::status(List()).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST_F(UsedKeysTest, WhoAsksForItMayAndIsNotedOnce) {
  for (int time = 0; time < 3; ++time) EXPECT_TRUE(NoteUse(Key(), Use(), true));
  EXPECT_TRUE(NoteUse(Key(), Use({}, "another"), true));
  const std::string text = Text();
  EXPECT_EQ(std::ranges::count(text, '\n'), 2);
  EXPECT_NE(Complaint(Key(), Use()), "");
}

TEST_F(UsedKeysTest, OtherShardsOfTheSameRunShareTheKeyAndNothingElseDoes) {
  EXPECT_EQ(Complaint(Key(), Use({1, 3})), "");
  EXPECT_EQ(Complaint(Key(), Use({3, 3})), "");
  EXPECT_EQ(Complaint(Key(), Use({2, 3})), "");
  EXPECT_NE(Complaint(Key(), Use({2, 3})), "") << "the same shard again";
  EXPECT_NE(Complaint(Key(), Use({4, 4})), "") << "cut into other shards";
  EXPECT_NE(Complaint(Key(), Use({1, 1})), "") << "all of it";
  EXPECT_NE(Complaint(Key(), Use({1, 3}, "another suite's")), "");
  KeyUse exported = Use({1, 3});
  exported.command = "export";
  EXPECT_NE(Complaint(Key(), exported), "");
}

TEST_F(UsedKeysTest, ShardsThatBeginAtTheSameTimeAllStandInTheList) {
  constexpr int kShards = 12;
  std::vector<pid_t> children;
  for (int index = 1; index <= kShards; ++index) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(NoteUse(Key(), Use({index, kShards}), false) ? 0 : 1);
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  const std::string text = Text();
  EXPECT_EQ(std::ranges::count(text, '\n'), kShards);
}

TEST_F(UsedKeysTest, ANewKeyInTheSameFileIsFreeAndALinkLeadsToTheList) {
  EXPECT_EQ(Complaint(Key(), Use()), "");
  EXPECT_EQ(Complaint(Key(7), Use()), "");
  const auto link = folder_->path() / "link";
  std::filesystem::create_symlink(File(), link);
  EXPECT_THAT(Complaint({Key().words, link}, Use()), HasSubstr("was used before"));
}

TEST_F(UsedKeysTest, AKeyWithoutAFileHasNoList) {
  for (const char* file : {"", "/dev/null"}) {
    for (int time = 0; time < 2; ++time) EXPECT_EQ(Complaint({Key().words, file}, Use()), "") << file;
  }
  EXPECT_FALSE(std::filesystem::exists("/dev/null.used"));
}

TEST_F(UsedKeysTest, WhatAKillLeftOfALineIsCutOffAndAnythingElseRefusedWithItsPlace) {
  EXPECT_EQ(Complaint(Key(), Use()), "");
  const std::string line = Text();
  for (std::size_t cut = 0; cut < line.size(); cut += 9) {
    std::ofstream(List()) << line.substr(0, cut);
    EXPECT_EQ(Complaint(Key(), Use()), "") << cut;
    EXPECT_EQ(Text(), line) << cut;
  }
  for (const char* odd : {"x\n", "[]\n", "{}\n", "{\"key\":1}\n", "\n"}) {
    std::ofstream(List()) << line << odd;
    EXPECT_THAT(Complaint(Key(2), Use()), HasSubstr(List() + ":2")) << odd;
    EXPECT_TRUE(NoteUse(Key(2), Use(), true)) << "who asks for it need not mend the list";
  }
}

TEST_F(UsedKeysTest, ARepeatedRunIsNotedUnlessTheKeyIsKnownAsUsed) {
  KeyUse repeat = Use();
  repeat.command = "replay";
  EXPECT_TRUE(NoteRepeat(Key(), repeat));
  EXPECT_TRUE(NoteRepeat(Key(), repeat));
  const std::string noted = Text();
  EXPECT_EQ(std::ranges::count(noted, '\n'), 1);
  EXPECT_THAT(Complaint(Key(), Use()), HasSubstr("was used before: 'etude replay'"));
  EXPECT_EQ(Complaint(Key(7), Use()), "");
  EXPECT_TRUE(NoteRepeat(Key(7), repeat));
  const std::string used = Text();
  EXPECT_EQ(std::ranges::count(used, '\n'), 2) << "its own run is there";
  std::filesystem::remove(List());
  std::filesystem::create_directory(List());
  EXPECT_FALSE(NoteRepeat(Key(), repeat));
}

TEST_F(UsedKeysTest, AListThatCannotBeWrittenIsRefused) {
  std::filesystem::create_directory(List());
  EXPECT_THAT(Complaint(Key(), Use()), HasSubstr("cannot be written (Is a directory), so etude cannot record that the "
                                                 "key was used"));
  EXPECT_TRUE(NoteUse(Key(), Use(), true));
  std::filesystem::remove(List());
  std::filesystem::create_symlink(folder_->path() / "elsewhere", List());
  EXPECT_THAT(Complaint(Key(), Use()), HasSubstr("cannot be written"));
  EXPECT_FALSE(std::filesystem::exists(folder_->path() / "elsewhere"));
}

}  // namespace
}  // namespace etude
