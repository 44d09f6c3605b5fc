#include "bench/tasks/plausibility/find_clips.h"

#include <gmock/gmock.h>

#include "engine/document/node.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class FindLoneClipsTest : public ::testing::Test {
 protected:
  std::string Make(const std::string& name) {
    EXPECT_TRUE(WriteFileAtomically(folder_.path() / name, "x"));
    return (folder_.path() / name).string();
  }
  /// Finds the clips of methods; in their texts '@' stands for the folder.
  Result<FoundFiles> Find(const std::vector<std::string>& methods, const std::string& condition = "{}") {
    std::vector<Node> nodes;
    for (std::string text : methods) {
      for (std::size_t at; (at = text.find('@')) != std::string::npos;) text.replace(at, 1, folder_.path().string());
      nodes.push_back(*ParseYaml(text, "s.yaml"));
    }
    return FindLoneClips(*ParseYaml(condition, "s.yaml"), nodes, {});
  }

  TemporaryFolder folder_ = *TemporaryFolder::Make("plausibility-test");
};

TEST_F(FindLoneClipsTest, ClipsOfOneNameOfSeveralMethodsAreOneWorld) {
  const std::string a = Make("m/a.bvh"), b = Make("m/b.bvh"), other = Make("n/b.npz");
  ASSERT_OK(found, Find({"{name: m, answers: ['@/m']}", "{name: n, answers: ['@/n/*']}"}));
  const std::vector<JudgedFiles> expected = {{"a", "", "", {a, ""}}, {"b", "", "", {b, other}}};
  EXPECT_EQ(found->worlds, expected);
}

TEST_F(FindLoneClipsTest, NamesHoldTheFoldersOfWildcardsAndExtensionsIfNeeded) {
  const std::string walk = Make("x/walk.bvh"), too = Make("y/walk.bvh"), arrays = Make("y/walk.npz");
  ASSERT_OK(found, Find({"{name: m, answers: ['@/*/walk.*']}"}));
  const std::vector<JudgedFiles> expected = {
      {"x/walk", "", "", {walk}}, {"y/walk.bvh", "", "", {too}}, {"y/walk.npz", "", "", {arrays}}};
  EXPECT_EQ(found->worlds, expected);
  EXPECT_THAT(testing::Refusal(Find({"{name: m, answers: ['@/x', '@/y/walk.bvh']}"})), HasSubstr("have the same name"));
}

TEST_F(FindLoneClipsTest, PeopleAreUnitsAndTrialsAreRefused) {
  Make("m/p1_a.bvh");
  Make("m/p2_a.bvh");
  ASSERT_OK(found, Find({"{name: m, answers: ['@/m']}"}, "people: '{person}_*'"));
  EXPECT_EQ(found->worlds[0].unit, "p1");
  EXPECT_EQ(found->worlds[1].unit, "p2");
  EXPECT_FALSE(Find({"{name: m, answers: ['@/m']}"}, "people: '{person}-*'"));
  EXPECT_FALSE(Find({"{name: m, answers: ['@/m']}"}, "trials: 2"));
  EXPECT_FALSE(Find({"{name: m}"}));
}

}  // namespace
}  // namespace etude
