#include "tests/bench/scenario/parse.h"
#include "tests/support/kept_answers.h"

namespace etude {
namespace {

// Complaints tell file, line and column, what was found, and what is allowed.
TEST(Scenario, TellsWhatIsWrongAndWhere) {
  EXPECT_TRUE(testing::AnswersAreKept("tests/bench/scenario/complaints.txt", [](std::string text) {
    // " | NAME: TEXT" is a further file; a file that includes others is a whole scenario otherwise.
    SourceTexts more;
    for (std::size_t bar; (bar = text.rfind(" | ")) != std::string::npos; text.erase(bar)) {
      const std::size_t colon = text.find(": ", bar);
      more[text.substr(bar + 3, colon - bar - 3)] = text.substr(colon + 2);
    }
    const std::string complaint = Complaint(more.empty() ? text : text + "\n" + kHead + kMethods, more);
    return complaint.empty() ? "accepted" : complaint;
  }));
}

}  // namespace
}  // namespace etude
