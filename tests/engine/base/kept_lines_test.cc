#include "tests/support/kept_lines.h"

#include <filesystem>

#include "tests/support/kept_answers.h"

namespace etude::testing {
namespace {

TEST(KeptLines, NameTheFirstLineThatDiffersAndAreNotWrittenUnasked) {
  const std::string path = ::testing::TempDir() + "kept_lines.txt";
  std::ofstream(path) << "one\ntwo\n";
  EXPECT_TRUE(AreKept({"one", "two"}, path));
  for (const std::vector<std::string>& other :
       {std::vector<std::string>{"one", "three"}, {"one"}, {"one", "two", "three"}, {}}) {
    EXPECT_FALSE(AreKept(other, path)) << other.size();
  }
  EXPECT_EQ(std::string(AreKept({"one", "three"}, path).message()).find(path + ":2: is  'three'\n  was 'two'"), 0u);
  EXPECT_TRUE(AreKept({"one", "two"}, path)) << "the file is as it was";
  std::filesystem::remove(path);
  EXPECT_FALSE(AreKept({}, path)) << "there is no file";
}

TEST(KeptAnswers, AreComparedLineByLine) {
  const std::string path = ::testing::TempDir() + "kept_answers.txt";
  const auto answer = [](const std::string& text) { return std::to_string(text.size()); };
  std::ofstream(path) << "# a\none\n  3\n@ [\\n…]\nfour\n  7\n";
  EXPECT_TRUE(AnswersAreKept(path, answer));
  EXPECT_FALSE(AnswersAreKept(path, [](const std::string& text) { return text; }));
  std::ofstream(path) << "# a\n";
  EXPECT_FALSE(AnswersAreKept(path, answer)) << "it asks nothing";
  std::filesystem::remove(path);
  EXPECT_EQ(Edited("a b a", "a => c"), "c b a");
}

TEST(ComplaintLines, HoldOneComplaintOfAKind) {
  ComplaintLines complaints;
  complaints.Add("numbers", std::vector{1, 2, 30, 4, 5}, [](int number) -> Result<int> {
    if (number == 1) return number;
    return number < 5 ? Fail({"f", number}, "'{}' is odd", number) : Fail({"f", number}, "is large");
  });
  EXPECT_EQ(complaints.lines(),
            (std::vector<std::string>{"numbers: 1 of 5 are read", "  f:2: '2' is odd", "  f:30: is large"}));
}

TEST(ComplaintLines, LeaveOutTheWordsOfLibraries) {
  ComplaintLines complaints;
  complaints.Add("words", std::vector<const char*>{"old", "new"}, [](const char* words) -> Result<int> {
    return Fail({"f", 7}, "not valid YAML: {} words", words);
  });
  EXPECT_EQ(complaints.lines(), (std::vector<std::string>{"words: 0 of 2 are read", "  f:7: not valid YAML: …"}));
}

}  // namespace
}  // namespace etude::testing
