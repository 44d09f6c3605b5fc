#include <filesystem>
#include <sstream>

#include "bench/scenario/keys.h"
#include "bench/tasks/registry.h"
#include "io/clips/clip_library.h"
#include "io/files/files.h"
#include "tests/bench/scenario/parse.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

std::string ReadPage(const std::string& name) {
  const auto text = ReadWholeFile(std::filesystem::path("docs") / name);
  EXPECT_TRUE(text) << name;
  return text.value_or("");
}

/// The YAML blocks of a page: whole files, named by their first line, and pieces of scenarios.
struct Blocks {
  SourceTexts files;
  std::vector<std::string> pieces;
};

Blocks BlocksOf(const std::string& page) {
  Blocks blocks;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line != "```yaml") continue;
    std::string text, first;
    for (std::getline(lines, first), line = first; line != "```"; std::getline(lines, line)) text += line + "\n";
    if (first.starts_with("# ")) {
      EXPECT_TRUE(blocks.files.emplace(first.substr(2), text).second) << first;
    } else {
      blocks.pieces.push_back(text);
    }
  }
  return blocks;
}

/// Returns a complete scenario: the piece and the keys that it lacks.
std::string Complete(const std::string& piece) {
  const std::vector<std::pair<std::string, std::string>> needed = {
      {"scenario", "s"},
      {"question", "q"},
      {"task", "ik"},
      {"methods", "[{name: fixed, solver: ccd, weights: fixed}, {name: adaptive, solver: ccd, weights: adaptive}]"}};
  std::string whole = piece;
  for (const auto& [key, value] : needed) {
    if (!piece.starts_with(key + ":") && piece.find("\n" + key + ":") == std::string::npos) {
      whole += key + ": " + value + "\n";
    }
  }
  return whole;
}

/// Returns the error message about the scenarios of a file, including the values of their task's keys.
std::string ComplaintOfAll(const std::string& file, const SourceTexts& texts, const ClipLibrary& clips) {
  const auto scenarios = ParseScenarios(file, texts);
  if (!scenarios) return ToString(scenarios.error());
  for (const Scenario& scenario : *scenarios) {
    std::vector<Node> methods;
    for (const MethodEntry& method : scenario.methods) {
      if (method.exec.empty()) methods.push_back(method.node);
    }
    for (const Condition& condition : scenario.conditions) {
      Fields fields(condition.node, "a scenario");
      for (const KeyInfo& key : CommonScenarioKeys()) fields.Raw(key.key);
      TaskInput input{fields, methods, clips};
      const auto task = FindTaskKind(scenario.task)->make(input);
      if (!task) return ToString(task.error());
      if (const auto done = fields.Finish(); !done) return ToString(done.error());
    }
  }
  return "";
}

TEST(Documents, ShowScenariosThatAreRead) {
  ASSERT_OK(clips, LoadClips({"builtin:boxing"}, {}));
  const Blocks blocks = BlocksOf(ReadPage("scenarios.md"));
  ASSERT_GE(blocks.files.size(), 3u);
  ASSERT_GE(blocks.pieces.size(), 5u);
  for (const auto& [name, text] : blocks.files) {
    if (name.starts_with("shared/")) continue;  // these files are only included by others
    EXPECT_EQ(ComplaintOfAll(name, blocks.files, *clips), "") << name;
  }
  for (const std::string& piece : blocks.pieces) {
    EXPECT_EQ(ComplaintOfAll("s.yaml", {{"s.yaml", Complete(piece)}}, *clips), "") << piece;
  }
}

TEST(Documents, WouldBeCaughtShowingWhatIsNotRead) {
  ASSERT_OK(clips, LoadClips({"builtin:boxing"}, {}));
  const Blocks blocks = BlocksOf("Text.\n```yaml\nsweep: {poses: [2]}\n```\n```yaml\nsweeps: {}\n```\n");
  ASSERT_EQ(blocks.pieces.size(), 2u);
  const auto complaint = [&](const std::string& piece) {
    return ComplaintOfAll("s.yaml", {{"s.yaml", Complete(piece)}}, *clips);
  };
  EXPECT_THAT(complaint(blocks.pieces[0]), HasSubstr("2 is out of range"));
  EXPECT_THAT(complaint(blocks.pieces[1]), HasSubstr("did you mean 'sweep'?"));
}

TEST(Documents, OfScenariosInTheRepositoryAreRead) {
  ASSERT_OK(clips, LoadClips({"builtin:boxing", "builtin:clap"}, {}));
  int count = 0;
  for (const std::string folder : {"quick", "paper", "full"}) {
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path("scenarios") / folder)) {
      if (entry.path().extension() != ".yaml") continue;
      const std::string name = entry.path().filename().string();
      ASSERT_OK(text, ReadWholeFile(entry.path())) << name;
      EXPECT_EQ(ComplaintOfAll(name, {{name, *text}}, *clips), "") << name;
      ++count;
    }
  }
  EXPECT_GE(count, 10);
}

TEST(Documents, ListEveryKeyAsTheProgramDoes) {
  EXPECT_EQ(ReadPage("reference/keys.md"), KeysAsMarkdown())
      << "write it anew: etude list keys --markdown > docs/reference/keys.md";
}

TEST(Documents, HoldTheSchemaThatTheProgramWrites) {
  EXPECT_EQ(ReadPage("schemas/scenario.schema.json"), KeysAsSchema())
      << "write it anew: etude list keys --schema > docs/schemas/scenario.schema.json";
}

}  // namespace
}  // namespace etude
