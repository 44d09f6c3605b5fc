#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/tasks/registry.h"
#include "tests/bench/tasks/base/make_task.h"
#include "tests/support/kept_answers.h"

namespace etude {
namespace {

/// Returns the error message about "TASK | KEYS OF THE CONDITION | METHODS".
std::string ComplaintOfTask(const std::string& text, const ClipLibrary& clips) {
  const std::size_t first = text.find(" | "), last = text.rfind("| ");
  const TaskKind& kind = *FindTaskKind(text.substr(0, first));
  return testing::Refusal(
      MakeTask(kind, "{" + text.substr(first + 3, last - first - 3) + "}", "[" + text.substr(last + 2) + "]", clips));
}

// Each error message gives the value's place, what was found, and what is allowed or was probably meant.
TEST(Tasks, SayWhatTheyDoNotKnowAndWhereItStands) {
  ASSERT_OK(clips, LoadClips({"builtin:clap", "builtin:boxing", "builtin:sway", "builtin:side_kick"}, {}));
  EXPECT_TRUE(testing::AnswersAreKept("tests/bench/tasks/complaints.txt",
                                      [&](const std::string& text) { return ComplaintOfTask(text, *clips); }));
}

TEST(Tasks, ThatUseClipsNeedSome) {
  for (const char* text :
       {"tracking | | {name: a}", "detection | | {name: a}", "pose-distance | pairs: frames | {name: a}"}) {
    EXPECT_THAT(ComplaintOfTask(text, {}), ::testing::ContainsRegex("needs '?clips")) << text;
  }
}

}  // namespace
}  // namespace etude
