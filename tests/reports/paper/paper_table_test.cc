#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/paper/paper_b_tables.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

PaperTable Small() {
  return {"(b) after <me> & 50 %",
          {{"position error (cm)", {"X", "Y"}}, {"orientation error (degrees)", {"X"}}},
          {{"R_hand", {-1.5, std::nullopt, 1e-7}}, {"head", {1234.25, 0.0, 2.0 / 3}}}};
}

TEST(PaperTable, PrintsSixDecimalsAndADashForWhatIsNot) {
  EXPECT_THAT(TableHtml(TableOf(Small())), HasSubstr("<th scope=\"row\">R_hand</th><td class=\"n\">−1.500000</td>"
                                                     "<td class=\"n\">—</td><td class=\"n\">0.000000</td>"));
  EXPECT_THAT(TableMarkdown(TableOf(Small())), HasSubstr("| R\\_hand | −1.500000 | — | 0.000000 |\n"));
  EXPECT_THAT(TableLatex(TableOf(Small())), HasSubstr("R\\_hand & $-$1.500000 & --- & 0.000000 \\\\\n"));
  EXPECT_THAT(TableLatex(TableOf(Small())), HasSubstr("head & 1,234.250000 & 0.000000 & 0.666667 \\\\\n"));
}

TEST(PaperTable, LeavesNothingUnescaped) {
  EXPECT_THAT(TableHtml(TableOf(Small())), Not(HasSubstr("<me>")));
  EXPECT_THAT(TableMarkdown(TableOf(Small())), Not(HasSubstr(" <me>")));
  EXPECT_THAT(TableLatex(TableOf(Small())), HasSubstr("(b) after \\textless{}me\\textgreater{} \\& 50 \\%\\\\"));
}

TEST(PaperTable, HeadsOfLatexSpanTheirColumns) {
  const std::string latex = TableLatex(TableOf(Small()));
  EXPECT_THAT(latex, HasSubstr("\\begin{tabular}{lrrr}"));
  EXPECT_THAT(latex, HasSubstr(" & \\multicolumn{2}{c}{position error (cm)} & \\multicolumn{1}{c}{orientation"));
  EXPECT_THAT(latex, HasSubstr("\\cmidrule(lr){2-3}\\cmidrule(lr){4-4}"));
}

TEST(PaperTable, KeepsAllDigitsBesideTheSixThatItShows) {
  const Table table = TableOf(Small());
  EXPECT_EQ(table.rows[1].cells[3].number, 2.0 / 3);
  EXPECT_EQ(table.rows[0].cells[2].number, std::nullopt);
}

TEST(PaperLetter, GoesOnWithNumbersAfterZ) {
  EXPECT_EQ(PaperLetter(0), "(a)");
  EXPECT_EQ(PaperLetter(25), "(z)");
  EXPECT_EQ(PaperLetter(26), "(27)");
}

}  // namespace
}  // namespace etude
