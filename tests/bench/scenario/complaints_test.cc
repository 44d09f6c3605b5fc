#include "tests/bench/scenario/parse.h"
#include "tests/support/kept_answers.h"

namespace etude {
namespace {

// Each error message gives file, line and column, the value found, and the allowed values.
TEST(Scenario, TellsWhatIsWrongAndWhere) {
  EXPECT_TRUE(testing::AnswersAreKept("tests/bench/scenario/complaints.txt", [](std::string text) {
    // " | NAME: TEXT" adds a further file. A text that includes other files is otherwise a complete scenario.
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
