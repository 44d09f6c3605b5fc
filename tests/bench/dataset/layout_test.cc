#include "bench/dataset/layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "bench/run/suite.h"
#include "io/files/temporary_folder.h"
#include "tests/support/results.h"

namespace etude {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Scenario Swept(std::initializer_list<std::vector<SweptValue>> conditions) {
  Scenario scenario;
  for (const std::vector<SweptValue>& settings : conditions) scenario.conditions.push_back({settings, {}});
  return scenario;
}

TEST(Layout, NamesAConditionByItsValues) {
  EXPECT_THAT(ConditionFolders(Swept({{}})), ElementsAre("all"));
  EXPECT_THAT(ConditionFolders(Swept({{{"noise_deg", "5"}, {"noise", "uniform"}}, {{"noise_deg", "-0.5"}}})),
              ElementsAre("noise_deg=5,noise=uniform", "noise_deg=-0.5"));
}

TEST(Layout, GivesConditionsOneNameEachThatCannotLeaveTheirFolder) {
  EXPECT_THAT(ConditionFolders(Swept({{{"a", "../x y"}}, {{"a", "../x/y"}}, {{"a", "../x~y"}}})),
              ElementsAre("a=.._x_y", "a=.._x_y~2", "a=.._x_y~3"));
  const std::string longest(5000, 'v');
  for (const std::string& name : ConditionFolders(Swept({{{"a", longest}}, {{"b", longest}}}))) {
    EXPECT_LT(name.size(), 250u);
  }
}

constexpr char kScenario[] = R"(
scenario: ik
question: Which answers are there?
task: ik
trials: 2
sweep: {joint_noise_deg: [2, 5]}
methods: [{name: today, solver: damped-least-squares}]
)";

class Predictions : public ::testing::Test {
 protected:
  Predictions() : folder_(*TemporaryFolder::Make("predictions-test")) {
    Write("ik.yaml", kScenario);
    RunOptions options;
    options.scenarios = {(folder_.path() / "ik.yaml").string()};
    const auto suite = ReadSuite(options);
    EXPECT_TRUE(suite) << ToString(suite.error());
    scenarios_ = *PrepareAll(*suite);
  }

  void Write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_.path() / name).parent_path());
    std::ofstream(folder_.path() / name) << text;
  }

  /// Writes empty answers to files of `answers/`, and finds them.
  Result<PredictionFiles> Find(const std::vector<std::string>& files) {
    fs::create_directories(folder_.path() / "answers");
    for (const std::string& file : files) Write("answers/" + file, "{}");
    return FindPredictions(folder_.path() / "answers", Plan(scenarios_), faults_);
  }

  const TemporaryFolder folder_;
  std::vector<PreparedScenario> scenarios_;
  PredictionFaults faults_;
};

TEST_F(Predictions, AreFoundUnderTheNamesOfTheirWorlds) {
  ASSERT_OK(files, Find({"ik/joint_noise_deg=2/000.json", "ik/joint_noise_deg=2/1.json",
                         "ik/joint_noise_deg=5/001.JSON", ".DS_Store", ".git/config"}));
  ASSERT_EQ(files->size(), 4u);
  EXPECT_EQ((*files)[0]->below().filename(), "000.json");
  EXPECT_EQ((*files)[1]->below().filename(), "1.json");
  EXPECT_FALSE((*files)[2]);
  EXPECT_EQ((*files)[3]->below().filename(), "001.JSON");
  EXPECT_TRUE(faults_.empty());
}

TEST_F(Predictions, NameTrialsByThreeDigitsOrMore) {
  EXPECT_EQ(WorldName(scenarios_[0], 0, 7), "007");
  EXPECT_EQ(WorldName(scenarios_[0], 1, 12345), "12345");
}

TEST_F(Predictions, ThatAnswerNoWorldAreExtra) {
  const auto files =
      Find({"ik/joint_noise_deg=2/002.json", "ik/joint_noise_deg=9/000.json", "kk/joint_noise_deg=2/0.json",
            "ik/joint_noise_deg=2/-1.json", "ik/joint_noise_deg=2/000.txt", "ik/000.json",
            "ik/joint_noise_deg=2/0x1.json", "ik/joint_noise_deg=2/99999999999999999999.json"});
  ASSERT_TRUE(files);
  EXPECT_EQ(faults_.extra.size(), 8u);
  EXPECT_THAT(faults_.duplicate, IsEmpty());
  EXPECT_FALSE((*files)[0]);
}

TEST_F(Predictions, ThatAnswerAWorldTwiceAreDuplicates) {
  ASSERT_TRUE(Find({"ik/joint_noise_deg=2/0.json", "ik/joint_noise_deg=2/000.json", "ik/joint_noise_deg=2/000.JSON"}));
  EXPECT_THAT(faults_.duplicate, ElementsAre("ik/joint_noise_deg=2/000.JSON (as ik/joint_noise_deg=2/0.json)",
                                             "ik/joint_noise_deg=2/000.json (as ik/joint_noise_deg=2/0.json)"));
}

TEST_F(Predictions, ThatAreLinksOrNoFilesAreBrokenAndNotOpened) {
  Write("truth.json", "{}");
  fs::create_directories(folder_.path() / "answers/ik");
  fs::create_directories(folder_.path() / "truth");
  fs::create_directory_symlink(folder_.path() / "truth", folder_.path() / "answers/ik/joint_noise_deg=5");
  Write("answers/ik/joint_noise_deg=2/000.json", "{}");
  fs::create_symlink(folder_.path() / "truth.json", folder_.path() / "answers/ik/joint_noise_deg=2/001.json");
  fs::create_symlink(folder_.path() / "truth.json", folder_.path() / "answers/.note");
  ASSERT_OK(files, Find({}));
  EXPECT_THAT(faults_.broken,
              ElementsAre("ik/joint_noise_deg=2/001.json is a link; allowed: regular files that are not links",
                          "ik/joint_noise_deg=5 is a link; allowed: regular files that are not links"));
  EXPECT_TRUE((*files)[0]);
  EXPECT_FALSE((*files)[1]);
  EXPECT_FALSE((*files)[2]);
}

TEST_F(Predictions, NeedAFolder) {
  EXPECT_FALSE(FindPredictions(folder_.path() / "nowhere", Plan(scenarios_), faults_));
  EXPECT_FALSE(FindPredictions(folder_.path() / "ik.yaml", Plan(scenarios_), faults_));
}

}  // namespace
}  // namespace etude
