#include "reports/escape.h"

#include <gtest/gtest.h>

#include <vector>

namespace etude {
namespace {

std::string EncodedText(std::string_view text) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
  return Base64(std::span(bytes, text.size()));
}

// RFC 4648, section 10.
TEST(Base64, GivesThePublishedVectors) {
  EXPECT_EQ(EncodedText(""), "");
  EXPECT_EQ(EncodedText("f"), "Zg==");
  EXPECT_EQ(EncodedText("fo"), "Zm8=");
  EXPECT_EQ(EncodedText("foo"), "Zm9v");
  EXPECT_EQ(EncodedText("foob"), "Zm9vYg==");
  EXPECT_EQ(EncodedText("foobar"), "Zm9vYmFy");
  EXPECT_EQ(EncodedText("\xff\xef\xfe"), "/+/+");
}

TEST(Markup, LeavesNoCharacterThatCouldOpenAnything) {
  EXPECT_EQ(EscapeMarkup("</script><b a=\"1\" c='2'>&"), "&lt;/script&gt;&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;");
  EXPECT_EQ(EscapeMarkup("größer → 5 °, 𝄞"), "größer → 5 °, 𝄞");
}

TEST(Markup, ReplacesWhatXmlForbids) {
  const std::string replaced = "\xEF\xBF\xBD";
  EXPECT_EQ(EscapeMarkup(std::string("a\0b", 3)), "a" + replaced + "b");
  EXPECT_EQ(EscapeMarkup("\x1b"), replaced);
  EXPECT_EQ(EscapeMarkup("\xff"), replaced);                                // never UTF-8
  EXPECT_EQ(EscapeMarkup("\xc3"), replaced);                                // cut short
  EXPECT_EQ(EscapeMarkup("\xc0\xaf"), replaced + replaced);                 // overlong "/"
  EXPECT_EQ(EscapeMarkup("\xed\xa0\x80"), replaced + replaced + replaced);  // a surrogate
  EXPECT_EQ(EscapeMarkup("\xef\xbf\xbf"), replaced + replaced + replaced);  // U+FFFF
}

TEST(ScriptJson, CannotEndItsElement) {
  EXPECT_EQ(EscapeScriptJson(R"({"a":"</script><!--"})"), R"({"a":"\u003c/script>\u003c!--"})");
}

TEST(Markdown, KeepsATableCellInOneCell) { EXPECT_EQ(EscapeMarkdown("a|b\n*c*"), "a\\|b \\*c\\*"); }

TEST(Csv, QuotesOnlyWhatNeedsIt) {
  EXPECT_EQ(EscapeCsv("plain"), "plain");
  EXPECT_EQ(EscapeCsv("a,b"), "\"a,b\"");
  EXPECT_EQ(EscapeCsv("say \"no\""), "\"say \"\"no\"\"\"");
}

}  // namespace
}  // namespace etude
