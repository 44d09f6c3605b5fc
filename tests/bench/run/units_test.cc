#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "engine/formats/bvh.h"
#include "engine/motion/clip.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "sim/choreography/move.h"
#include "tests/bench/run/prepared.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::string kTransitions = "task: transition\nmethods: [{name: a}]\n";

/// Built-in moves, and the same moves as files of two folders: three libraries.
class RowUnits : public ::testing::Test {
 protected:
  std::string File(const std::string& collection, const std::string& move) {
    const std::filesystem::path path = folder_.path() / collection / (move + ".bvh");
    std::filesystem::create_directories(path.parent_path());
    EXPECT_TRUE(WriteFileAtomically(path, WriteBvh(ToClip(LoadBuiltinMove(move).value().motion, move))));
    return path.string();
  }
  std::string Folder(const std::string& collection) const { return (folder_.path() / collection).string(); }

  static std::vector<Row> Rows(const std::string& text, const std::vector<std::string>& clips) {
    SuiteSetup suite = SmallSuite("scenario: small\nquestion: q\ntrials: 6\n" + text);
    suite.scenarios[0].clips = clips;
    suite.scenarios[0].trials = 6;
    const auto scenarios = Prepared(suite);
    std::vector<Row> rows;
    for (int trial = 0; trial < 6; ++trial) rows.push_back(scenarios[0].IdentityOf(0, trial, 0));
    return rows;
  }

  TemporaryFolder folder_ = *TemporaryFolder::Make("units-test");
};

TEST_F(RowUnits, OfClipPairsAreBothClipsOnceAndInOrder) {
  std::set<std::string> left_first;
  for (const Row& row : Rows(kTransitions, {"builtin:sway", "builtin:clap"})) {
    EXPECT_THAT(row.units, ElementsAre("builtin:clap", "builtin:sway"));
    left_first.insert(row.clip);
  }
  EXPECT_EQ(left_first.size(), 2u) << "whichever of them is left";
}

TEST_F(RowUnits, OfClipsAreTheOneThatIsShownFirst) {
  for (const Row& row : Rows("unit: clip\n" + kTransitions, {"builtin:sway", "builtin:clap"})) {
    ASSERT_NE(row.clip, "");
    EXPECT_THAT(row.units, ElementsAre(row.clip));
  }
}

TEST_F(RowUnits, AreNoneWhereEveryWorldIsItsOwn) {
  for (const Row& row : Rows("unit: world\n" + kTransitions, {"builtin:sway", "builtin:clap"})) {
    EXPECT_THAT(row.units, IsEmpty());
  }
}

TEST_F(RowUnits, OfLibrariesAreTheFoldersOfTheClipsShown) {
  const std::string text = "unit: library\n" + kTransitions;
  const std::string clap = File("a", "clap"), sway = File("a", "sway"), punch = File("b", "sway");
  for (const Row& row : Rows(text, {clap, sway})) EXPECT_THAT(row.units, ElementsAre(Folder("a")));
  for (const Row& row : Rows(text, {clap, punch})) EXPECT_THAT(row.units, ElementsAre(Folder("a"), Folder("b")));
  for (const Row& row : Rows(text, {"builtin:sway", "builtin:clap"})) EXPECT_THAT(row.units, ElementsAre("builtin"));
  std::set<std::size_t> counts;
  for (const Row& row : Rows(text, {clap, sway, "builtin:clap"})) {
    std::vector<std::string> expected = {Folder("a")};
    if (row.units.size() == 2) expected.push_back("builtin");
    EXPECT_EQ(row.units, expected);
    counts.insert(row.units.size());
  }
  EXPECT_EQ(counts, (std::set<std::size_t>{1, 2})) << "folders of clips that a world does not show do not count";
}

}  // namespace
}  // namespace etude
