#include "engine/base/csv.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

TEST(CsvText, QuotesOnlyWhatNeedsIt) {
  EXPECT_EQ(CsvText("plain"), "plain");
  EXPECT_EQ(CsvText("a,b"), "\"a,b\"");
  EXPECT_EQ(CsvText("say \"no\""), "\"say \"\"no\"\"\"");
  EXPECT_EQ(CsvText(""), "");
}

TEST(CsvText, IsNoFormulaToASpreadsheet) {
  EXPECT_EQ(CsvText("=cmd|' /C calc'!A0"), "'=cmd|' /C calc'!A0");
  EXPECT_EQ(CsvText("=HYPERLINK(\"http://x\",1)"), "\"'=HYPERLINK(\"\"http://x\"\",1)\"");
  for (const char* text : {"+1", "-1", "@sum", " =1", "＝1", "＋1", "－1", "＠x"}) {
    EXPECT_EQ(CsvText(text), "'" + std::string(text));
  }
  EXPECT_EQ(CsvText("\t=1"), "' =1");
  EXPECT_EQ(CsvText("\r=1"), "' =1");
  EXPECT_EQ(CsvText("a;=1"), "\"a;=1\"") << "where a semicolon separates, it would be a cell of its own";
  EXPECT_EQ(CsvText("a=1"), "a=1");
  EXPECT_EQ(CsvText("−1"), "−1") << "a minus sign begins no formula";
}

TEST(CsvText, IsALineAndShowsWhatIsHidden) {
  EXPECT_EQ(CsvText("two\nlines\x1b[2J"), "two lines [2J");
  EXPECT_EQ(CsvText("a\u202eb"), "a[U+202E]b");
}

}  // namespace
}  // namespace etude
