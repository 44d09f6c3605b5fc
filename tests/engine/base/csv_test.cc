#include "engine/base/csv.h"

#include <gmock/gmock.h>

#include "tests/support/results.h"

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

TEST(ReadCsv, TakesWhatSpreadsheetsAndLanguagesWrite) {
  using ::testing::ElementsAre;
  for (const char* text :
       {"truth,m\na b.npz,c\n", "\xEF\xBB\xBFtruth,m\r\na b.npz,c\r\n", "truth;m\na b.npz;c", "truth\tm\na b.npz\tc\n",
        "\"truth\",\"m\"\n\"a b.npz\",\"c\"\n", "truth, m\n a b.npz , \"c\"\n", "\ntruth,m\n\n  \na b.npz,c\n\n"}) {
    const auto rows = ReadCsv(text, "p.csv");
    ASSERT_TRUE(rows) << text;
    ASSERT_EQ(rows->size(), 2u) << text;
    EXPECT_THAT(rows->at(0).cells, ElementsAre("truth", "m")) << text;
    EXPECT_THAT(rows->at(1).cells, ElementsAre("a b.npz", "c")) << text;
  }
  const auto rows = ReadCsv("a,b,c\n\n,\"x, \"\"y\"\";z\",\n", "p.csv");
  ASSERT_TRUE(rows);
  EXPECT_THAT(rows->at(1).cells, ElementsAre("", "x, \"y\";z", ""));
  EXPECT_EQ(rows->at(1).line, 3);
  EXPECT_EQ(ReadCsv("", "p.csv")->size(), 0u);
  EXPECT_EQ(testing::Refusal(ReadCsv("a,b\nc,\"d\n", "p.csv")), "p.csv:2: cell 2 has no closing quotation mark");
}

}  // namespace
}  // namespace etude
