#include "bench/tasks/evaluation/find_files.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "engine/document/node.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class FindFilesTest : public ::testing::Test {
 protected:
  void Make(std::initializer_list<const char*> names) {
    for (const char* name : names) EXPECT_TRUE(WriteFileAtomically(folder_.path() / name, "x"));
  }
  std::string In(const std::string& name) const { return (folder_.path() / name).string(); }

  /// Finds the files of a scenario; '@' stands for the folder.
  Result<FoundFiles> Find(std::string condition, std::vector<std::string> methods, const std::string& csv = "") {
    const auto filled = [&](std::string text) {
      for (std::size_t at; (at = text.find('@')) != std::string::npos;) text.replace(at, 1, folder_.path().string());
      return text;
    };
    std::vector<Node> nodes;
    for (const std::string& method : methods) nodes.push_back(*ParseYaml(filled(method), "s.yaml"));
    return FindEvaluatedFiles(*ParseYaml(filled(condition), "s.yaml"), nodes, {{"pairs", filled(csv)}});
  }
  std::string Complaint(const std::string& condition, const std::vector<std::string>& methods,
                        const std::string& csv = "") {
    const auto found = Find(condition, methods, csv);
    EXPECT_FALSE(found);
    return found ? "" : ToString(found.error());
  }

  TemporaryFolder folder_ = *TemporaryFolder::Make("evaluation-test");
};

TEST_F(FindFilesTest, FilesOfOneNameAreAPair) {
  Make({"t/b.bvh", "t/a.bvh", "t/notes.md", "m/a.trc", "m/b.npz", "n/b.csv", "n/c.csv"});
  const auto found = Find("truth: ['@/t']", {"{name: m, answers: ['@/m/*']}", "{name: n, answers: ['@/n']}"});
  ASSERT_TRUE(found) << ToString(found.error());
  const std::vector<JudgedFiles> expected = {{"a", "", In("t/a.bvh"), {In("m/a.trc"), ""}},
                                             {"b", "", In("t/b.bvh"), {In("m/b.npz"), In("n/b.csv")}}};
  EXPECT_EQ(found->worlds, expected);
  ASSERT_EQ(found->left_out.size(), 1u);
  EXPECT_EQ(found->left_out[0].first, In("n/c.csv"));
}

TEST_F(FindFilesTest, AFolderStandsForItsFilesInAnyCaseAndTellsOfFoldersInside) {
  Make({"t/a.BVH", "t/.a.bvh", "t/old/b.bvh", "t/old/older/c.npz", "t/empty/notes.md", "m/a.trc"});
  const auto found = Find("truth: ['@/t']", {"{name: m, answers: ['@/m']}"});
  ASSERT_TRUE(found) << ToString(found.error());
  ASSERT_EQ(found->worlds.size(), 1u);
  EXPECT_EQ(found->worlds[0].truth, In("t/a.BVH"));
  ASSERT_EQ(found->left_out.size(), 1u);
  EXPECT_EQ(found->left_out[0], LeftOutFile(In("t/old"), "a folder in a folder, with 2 motion files; name it, too"));
}

TEST_F(FindFilesTest, OneTruthAndOneAnswerAreAPairWhateverTheirNames) {
  Make({"truth.bvh", "mine.bvh"});
  const auto found = Find("truth: ['@/truth.bvh']", {"{name: m, answers: ['@/mine.bvh']}"});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->worlds[0].answers[0], In("mine.bvh"));
}

TEST_F(FindFilesTest, OneFileOfAFolderOrPatternIsAPairOnlyByItsName) {
  Make({"t/run.bvh", "m/walk.bvh", "n/run.trc"});
  for (const char* truth : {"t", "t/*"}) {
    for (const char* answers : {"m", "m/w*", "m/walk.bvh"}) {
      EXPECT_THAT(Complaint("truth: ['@/" + std::string(truth) + "']",
                            {"{name: m, answers: ['@/" + std::string(answers) + "']}"}),
                  HasSubstr("none of the 1 answers of method 'm' has the name of a truth"));
    }
  }
  EXPECT_THAT(Complaint("truth: ['@/t/run.bvh']", {"{name: m, answers: ['@/m']}"}), HasSubstr("none of the 1 answers"));
  EXPECT_TRUE(Find("truth: ['@/t']", {"{name: m, answers: ['@/n']}"}));
}

TEST_F(FindFilesTest, AnswersThatAreLinksMustBeNamed) {
  Make({"t/a.bvh", "t/b.bvh", "u/b.bvh", "m/a.bvh"});
  std::filesystem::create_symlink(In("u/b.bvh"), In("m/b.bvh"));
  std::filesystem::create_symlink(In("u"), In("s"));
  const auto with = [&](const std::string& answers) { return "{name: m, answers: ['@/" + answers + "']}"; };
  for (const char* found : {"m", "m/*", "m/[b].bvh"}) {
    EXPECT_THAT(Complaint("truth: ['@/t']", {with(found)}), HasSubstr("m/b.bvh' is a link")) << found;
  }
  EXPECT_THAT(Complaint("truth: ['@/t']", {with("?/b.bvh")}), HasSubstr("is a link"));
  for (const char* named : {"m/b.bvh", "m/a*", "s", "s/*"}) {
    EXPECT_TRUE(Find("truth: ['@/t']", {with(named)})) << named;
  }
  EXPECT_TRUE(Find("truth: ['@/m']", {with("t")})) << "a truth is the judge's own";
}

TEST_F(FindFilesTest, AnAnswerIsNotTheTruthUnderAnotherName) {
  Make({"t/a.bvh", "t/b.bvh", "m/b.bvh"});
  std::filesystem::create_hard_link(In("t/a.bvh"), In("m/a.bvh"));
  const std::string both = "truth: ['@/t']";
  EXPECT_THAT(Complaint(both, {"{name: m, answers: ['@/m']}"}), HasSubstr("m/a.bvh' is the same file as the truth"));
  EXPECT_THAT(Complaint("pairs: p.csv", {"{name: m}"}, "truth,m\n@/t/a.bvh,@/m/a.bvh\n"), HasSubstr("is the same file "
                                                                                                    "as the truth"));
  EXPECT_TRUE(Find(both, {"{name: m, answers: ['@/t']}"})) << "who judges the truth by itself says so";
  EXPECT_TRUE(Find("pairs: p.csv", {"{name: m}"}, "truth,m\n@/t/a.bvh#x,@/m/a.bvh#y\n")) << "two motions of one file";
}

TEST_F(FindFilesTest, NamesMustBeText) {
  Make({"t/a.bvh", "m/\xFF.bvh"});
  for (const char* answers : {"m", "m/*"}) {
    EXPECT_THAT(Complaint("truth: ['@/t']", {std::string("{name: m, answers: ['@/") + answers + "']}"}),
                HasSubstr("s.yaml:1:20"));
  }
  EXPECT_THAT(Complaint("pairs: p.csv", {"{name: m}"}, "truth,m,name\nx,y,\xFF\n"), HasSubstr("p.csv:2"));
}

TEST_F(FindFilesTest, ATableTellsWhichBelongTogether) {
  Make({"t.bvh", "u.bvh", "x.bvh", "y.bvh"});
  const auto found =
      Find("pairs: p.csv", {"{name: m}", "{name: n}"}, "n,truth,m\r\n@/x.bvh,@/u.bvh,\n\n,@/t.bvh,@/y.bvh\n");
  ASSERT_TRUE(found) << ToString(found.error());
  const std::vector<JudgedFiles> expected = {{"t", "", In("t.bvh"), {In("y.bvh"), ""}},
                                             {"u", "", In("u.bvh"), {"", In("x.bvh")}}};
  EXPECT_EQ(found->worlds, expected);
}

TEST_F(FindFilesTest, ATableMayComeFromASpreadsheet) {
  Make({"t.bvh", "y.bvh"});
  for (const char* csv : {"\xEF\xBB\xBFtruth,m\n@/t.bvh,@/y.bvh\n", "truth;m\r\n@/t.bvh;@/y.bvh\r\n",
                          "\"truth\",\"m\"\n\"@/t.bvh\",\"@/y.bvh\"\n", "truth, m\n@/t.bvh, @/y.bvh\n"}) {
    const auto found = Find("pairs: p.csv", {"{name: m}"}, csv);
    ASSERT_TRUE(found) << ToString(found.error());
    EXPECT_EQ(found->worlds, (std::vector<JudgedFiles>{{"t", "", In("t.bvh"), {In("y.bvh")}}})) << csv;
  }
}

TEST_F(FindFilesTest, TheUnitIsThePersonInTheName) {
  Make({"t/01_02.bvh", "t/01_03.bvh", "t/02_01.bvh"});
  const auto found = Find("{truth: ['@/t'], people: '{person}_*'}", {"{name: m, answers: ['@/t']}"});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->worlds[0].unit, "01");
  EXPECT_EQ(found->worlds[1].unit, "01");
  EXPECT_EQ(found->worlds[2].unit, "02");
  EXPECT_EQ(PersonIn("*_S{person}A*", "take_S012A3"), "012");
  EXPECT_EQ(PersonIn("{person}", "all"), "all");
  EXPECT_EQ(PersonIn("{person}_*", "none"), std::nullopt);
  EXPECT_EQ(PersonIn("without", "without"), std::nullopt);
}

TEST_F(FindFilesTest, APersonsNameMayDifferInCaseAndSpaces) {
  Make({"t/ANNA_3.bvh", "t/Anna_1.bvh", "t/anna_2.bvh", "t/b ob_2.bvh", "t/Bob_1.bvh", "t/bobo_1.bvh"});
  const auto found = Find("{truth: ['@/t'], people: '{person}_*'}", {"{name: m, answers: ['@/t']}"});
  ASSERT_TRUE(found) << ToString(found.error());
  std::vector<std::string> units;
  for (const JudgedFiles& world : found->worlds) units.push_back(world.unit);
  EXPECT_THAT(units, ::testing::ElementsAre("ANNA", "ANNA", "Bob", "ANNA", "Bob", "bobo"));
}

TEST_F(FindFilesTest, WhatCannotBePairedIsRefused) {
  Make({"t/a.bvh", "t/b.bvh", "u/a.bvh", "m/c.bvh", "m/d.bvh"});
  const std::vector<std::string> m = {"{name: m, answers: ['@/m']}"};
  EXPECT_THAT(Complaint("truth: ['@/t']", m), HasSubstr("none of the 2 answers of method 'm' has the name of a truth"));
  EXPECT_THAT(Complaint("truth: ['@/t', '@/u']", m), HasSubstr("have the same name; use the key 'pairs'"));
  EXPECT_THAT(Complaint("truth: ['@/none']", m), HasSubstr("no clip matches"));
  EXPECT_THAT(Complaint("{}", m), HasSubstr("needs exactly one of the keys 'truth' and 'pairs'"));
  EXPECT_THAT(Complaint("truth: ['@/t']", {"{name: m}"}), HasSubstr("method 'm' has no 'answers'"));
  EXPECT_THAT(Complaint("{truth: ['@/t'], people: 'x'}", {"{name: m, answers: ['@/u/a.bvh', '@/t/b.bvh']}"}),
              HasSubstr("'x' does not match the name 'a'"));
  EXPECT_THAT(Complaint("{truth: ['@/t'], trials: 3}", m), HasSubstr("'trials' is not allowed"));
  EXPECT_THAT(Complaint("pairs: p.csv", m, "truth,m\n"), HasSubstr("'answers' and 'pairs' are not allowed together"));
  EXPECT_THAT(Complaint("pairs: p.csv", {"{name: m}"}, "truth,n\n"), HasSubstr("p.csv:1: unknown column 'n'"));
  EXPECT_THAT(Complaint("pairs: p.csv", {"{name: m}"}, "truth\n"), HasSubstr("has no column for method"));
  EXPECT_THAT(Complaint("pairs: p.csv", {"{name: m}"}, "truth,m\na\n"),
              HasSubstr("p.csv:2: found 1 cells, but the heading has 2"));
  EXPECT_THAT(Complaint("pairs: p.csv", {"{name: m}"}, "truth,m\nx/a.bvh,1\ny/a.bvh,2\n"),
              HasSubstr("two pairs have the name"));
  EXPECT_THAT(Complaint("pairs: p.csv", {"{name: m}"}, ""), HasSubstr("lists no pair"));
}

}  // namespace
}  // namespace etude
