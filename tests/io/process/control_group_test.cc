#include "io/process/control_group.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "io/files/temporary_folder.h"
#include "io/process/child_process.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMounts =
    "22 1 254:0 / / rw - ext4 /dev/vda rw\n"
    "36 24 0:30 / /sys/fs/cgroup rw,nosuid - cgroup2 cgroup2 rw\n";

TEST(OwnGroup, IsReadFromWhatTheKernelTellsOfAProcess) {
  const OwnGroup own = OwnGroup::Read("1:name=systemd:/x\n0::/user.slice/me.scope\n", kMounts);
  EXPECT_EQ(own.folder, "/sys/fs/cgroup/user.slice/me.scope");
  EXPECT_EQ(own.top, "/sys/fs/cgroup");
  EXPECT_EQ(OwnGroup::Read("0::/\n", kMounts).folder, "/sys/fs/cgroup");
}

TEST(OwnGroup, IsBelowTheGroupThatAContainerSeesAsItsTop) {
  const std::string mounts = "36 24 0:30 /machine/a /sys/fs/cgroup rw - cgroup2 cgroup2 rw\n";
  EXPECT_EQ(OwnGroup::Read("0::/machine/a/b\n", mounts).folder, "/sys/fs/cgroup/b");
  EXPECT_EQ(OwnGroup::Read("0::/machine/a\n", mounts).folder, "/sys/fs/cgroup");
  EXPECT_EQ(OwnGroup::Read("0::/machine/ab\n", mounts).folder, "") << "another's";
}

TEST(OwnGroup, IsNoneWithoutVersionTwo) {
  EXPECT_EQ(OwnGroup::Read("4:memory:/me\n", kMounts).folder, "");
  EXPECT_EQ(OwnGroup::Read("0::/me\n", "36 24 0:30 / /sys/fs/cgroup rw - cgroup cgroup rw,memory\n").folder, "");
  EXPECT_EQ(OwnGroup::Read("", "").folder, "");
}

TEST(HeldMb, CountsMemoryAndWhatTheKernelHoldsForIt) {
  const std::string mb = std::to_string(1 << 20), ten = std::to_string(10 << 20);
  EXPECT_DOUBLE_EQ(HeldMbIn("anon " + ten + "\nfile " + ten + "\nkernel " + mb + "\nshmem " + ten + "\nsock " + mb +
                                "\nslab_reclaimable 0\n",
                            mb + "\n"),
                   23);
  EXPECT_DOUBLE_EQ(HeldMbIn("anon 0\nkernel " + ten + "\nslab_reclaimable " + mb + "\n", ""), 9);
  EXPECT_DOUBLE_EQ(HeldMbIn("anon " + mb + "\nkernel_stack " + mb + "\npagetables " + mb + "\npercpu " + mb +
                                "\nslab_unreclaimable " + mb + "\nslab_reclaimable " + ten + "\n",
                            ""),
                   5)
      << "before Linux 5.18";
  EXPECT_EQ(HeldMbIn("", ""), 0);
}

/// Folders that look like control groups.
class FakeGroups : public ::testing::Test {
 protected:
  static void Give(const fs::path& group, const std::string& controllers) {
    fs::create_directories(group);
    std::ofstream(group / "cgroup.subtree_control") << controllers << "\n";
    std::ofstream(group / "cgroup.procs").flush();
  }
  OwnGroup Own() const { return {(top_ / "a" / "b").string(), top_.string()}; }

  const TemporaryFolder folder_ = *TemporaryFolder::Make("control-group-test");
  const fs::path top_ = folder_.path();
};

TEST_F(FakeGroups, ThePlaceIsTheNearestGroupThatCountsMemoryForThoseBelow) {
  Give(top_, "cpu memory");
  Give(top_ / "a", "memory pids");
  Give(top_ / "a" / "b", "cpu");
  EXPECT_EQ(ControlGroup::FindPlace(Own()), (top_ / "a").string());
  Give(top_ / "a" / "b", "memory");
  EXPECT_EQ(ControlGroup::FindPlace(Own()), (top_ / "a" / "b").string());
  Give(top_ / "a", "cpu memory.other");
  Give(top_ / "a" / "b", "");
  EXPECT_EQ(ControlGroup::FindPlace(Own()), top_.string());
  Give(top_, "cpu");
  EXPECT_EQ(ControlGroup::FindPlace(Own()), "") << "nobody counts memory";
  EXPECT_EQ(ControlGroup::FindPlace(OwnGroup{}), "");
}

TEST_F(FakeGroups, WhatKilledRunsHaveLeftIsRemovedAndNothingElse) {
  const pid_t gone = ::fork();
  if (gone == 0) ::_exit(0);
  ::waitpid(gone, nullptr, 0);
  Give(top_ / "a" / "b", "memory");
  const fs::path place = top_ / "a" / "b";
  const auto left = [&](const std::string& name) { return place / name; };
  const std::string dead = "etude-" + std::to_string(gone) + "-1", alive = "etude-" + std::to_string(::getpid()) + "-1";
  for (const std::string& name : {dead, alive, std::string("others"), std::string("etude-x")})
    fs::create_directory(left(name));
  ControlGroup::FindPlace(Own());
  EXPECT_FALSE(fs::exists(left(dead)));
  for (const std::string& name : {alive, std::string("others"), std::string("etude-x")})
    EXPECT_TRUE(fs::exists(left(name))) << name;
}

TEST_F(FakeGroups, NoGroupIsMadeWhereNoLimitCanBeSet) {
  EXPECT_FALSE(ControlGroup::Make("", 100).IsUp());
  EXPECT_FALSE(ControlGroup::Make((top_ / "none").string(), 100).IsUp());
  EXPECT_FALSE(ControlGroup::Make(top_.string(), 100).IsUp()) << "a folder without memory.max";
  EXPECT_TRUE(fs::is_empty(top_)) << "it takes away what it made";
}

ChildOptions Taker(const ControlGroup& group, int mb) {
  return {.program = "python3",
          .arguments = {"-c", "import sys\nheld = bytearray(b'x') * (" + std::to_string(mb) +
                                  " << 20)\nprint('taken', flush=True)\nsys.stdin.read()"},
          .contained = true,
          .control_group = group.folder()};
}

TEST(ControlGroup, CountsAndBoundsWhatAProgramHoldsAndGoesWithIt) {
  const std::string place = ControlGroup::FindPlace();
  if (place.empty()) GTEST_SKIP() << "this machine lets nobody make groups (cgroup v2 with memory, delegated)";
  const auto groups_there = [&] {
    return std::ranges::count_if(fs::directory_iterator(place), fs::directory_iterator(), [](const auto& entry) {
      return entry.path().filename().string().starts_with("etude-" + std::to_string(::getpid()) + "-");
    });
  };
  const auto before = groups_there();
  {
    ControlGroup group = ControlGroup::Make(place, 100);
    ASSERT_TRUE(group.IsUp());
    EXPECT_TRUE(group.IsEmpty());
    auto child = ChildProcess::Start(Taker(group, 60));
    ASSERT_TRUE(child);
    while (child->Receive() && !child->NextLine()) ::usleep(1000);
    EXPECT_FALSE(group.IsEmpty());
    EXPECT_GT(group.HeldMb(), 60);
    EXPECT_LT(group.HeldMb(), 100);
    EXPECT_FALSE(group.WasFull());
  }
  ControlGroup small = ControlGroup::Make(place, 20);
  {
    auto child = ChildProcess::Start(Taker(small, 400));
    ASSERT_TRUE(child);
    while (child->Receive()) ::usleep(1000);
  }
  EXPECT_TRUE(small.WasFull());
  small = ControlGroup();
  EXPECT_EQ(groups_there(), before);
}

}  // namespace
}  // namespace etude
