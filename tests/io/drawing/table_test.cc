#include "io/drawing/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace etude {
namespace {

using ::testing::HasSubstr;

/// Two groups; a column of numbers, and a column for experts.
Table Small() {
  Table table{.label = "Small",
              .style = "data",
              .columns = {{.head = "Who", .is_row_head = true},
                          {.head = "How far", .is_number = true, .is_sortable = true, .title = "far_cm"},
                          {.head = "Mind", .is_detail = true}}};
  table.rows = {{.group = "near & far", .attributes = " data-group=\"far\""},
                {{"a|b", {"1.5 cm", 1.5}, "=1"}},
                {{"<c>", {"—", std::nullopt, "<i>none</i>"}, ""}}};
  return table;
}

TEST(TableHtml, EscapesTextsAndSaysWhatEachCellIs) {
  EXPECT_EQ(TableHtml(Small()),
            "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Small\"><table class=\"data\">"
            "<thead><tr><th scope=\"col\">Who</th><th scope=\"col\" class=\"n\" title=\"far_cm\">How far</th>"
            "<th scope=\"col\" class=\"more\">Mind</th></tr></thead>"
            "<tbody data-group=\"far\"><tr class=\"group\"><th scope=\"rowgroup\" colspan=\"3\">near &amp; far"
            "</th></tr>"
            "<tr><th scope=\"row\">a|b</th><td class=\"n\" data-v=\"1.5\">1.5 cm</td><td class=\"more\">=1</td>"
            "</tr><tr><th scope=\"row\">&lt;c&gt;</th><td class=\"n\" data-v=\"\"><i>none</i></td>"
            "<td class=\"more\"></td></tr></tbody></table></div>");
}

TEST(TableMarkdown, EscapesTextsAndPutsNumbersAtTheRight) {
  EXPECT_EQ(TableMarkdown(Small()),
            "\n| Who | How far | Mind |\n|---|--:|---|\n| a\\|b | 1.5 cm | =1 |\n| \\<c\\> | — |  |\n");
}

TEST(TableLatex, HeadsGroupsAcrossAllColumns) {
  EXPECT_EQ(TableLatex(Small()),
            "\\begin{tabular}{lrl}\n\\toprule\nWho & How far & Mind \\\\\n"
            "\\midrule\n\\multicolumn{3}{l}{\\emph{near \\& far}} \\\\\n"
            "a\\textbar{}b & 1.5 cm & =1 \\\\\n\\textless{}c\\textgreater{} & --- & \\\\\n"
            "\\bottomrule\n\\end{tabular}\n");
}

TEST(TableCsv, HoldsNumbersInPlaceOfTheirTextsAndNoFormula) {
  EXPECT_EQ(TableCsv(Small()), "Who,How far,Mind\na|b,1.5,'=1\n<c>,—,\n");
  Table numbers{.columns = {{"n"}, {"x"}}};
  numbers.rows = {{{12, -0.1}}, {{0, std::optional<double>()}}};
  EXPECT_EQ(TableCsv(numbers), "n,x\n12,-0.1\n0,\n");
}

TEST(Table, HasASecondRowOfHeadsThatNeighboursShare) {
  Table table{.columns = {{.is_row_head = true}, {.head = "X", .over = "cm"}, {.head = "Y", .over = "cm"}}};
  table.rows = {{{"foot", "1", "2"}}};
  EXPECT_THAT(TableHtml(table), HasSubstr("<tr><td></td><th scope=\"colgroup\" colspan=\"2\">cm</th></tr>"));
  EXPECT_THAT(TableMarkdown(table), HasSubstr("| | cm X | cm Y |\n"));
  EXPECT_THAT(TableLatex(table), HasSubstr(" & \\multicolumn{2}{c}{cm} \\\\\n\\cmidrule(lr){2-3}\n & X & Y "));
}

}  // namespace
}  // namespace etude
