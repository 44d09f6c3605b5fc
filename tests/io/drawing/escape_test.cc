#include "io/drawing/escape.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

TEST(Markup, LeavesNoCharacterThatCouldOpenAnything) {
  EXPECT_EQ(EscapeMarkup("</script><b a=\"1\" c='2'>&"), "&lt;/script&gt;&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;");
  EXPECT_EQ(EscapeMarkup("größer → 5 °, 𝄞"), "größer → 5 °, 𝄞");
}

TEST(Markup, ReplacesWhatXmlForbids) {
  const std::string replaced = "\xEF\xBF\xBD";
  EXPECT_EQ(EscapeMarkup(std::string("a\0b", 3)), "a" + replaced + "b");
  EXPECT_EQ(EscapeMarkup("\x1b"), replaced);
  EXPECT_EQ(EscapeMarkup("\xff"), replaced);                                // never UTF-8
  EXPECT_EQ(EscapeMarkup("\xc3"), replaced);                                // truncated
  EXPECT_EQ(EscapeMarkup("\xc0\xaf"), replaced + replaced);                 // overlong "/"
  EXPECT_EQ(EscapeMarkup("\xed\xa0\x80"), replaced + replaced + replaced);  // a surrogate
  EXPECT_EQ(EscapeMarkup("\xef\xbf\xbf"), replaced + replaced + replaced);  // U+FFFF
}

TEST(Markup, ShowsWhatTurnsTextAround) {
  EXPECT_EQ(EscapeMarkup("a\u202eb\u2066c"), "a[U+202E]b[U+2066]c");
  EXPECT_EQ(EscapeMarkdown("a\u202eb|"), "a\\[U+202E\\]b\\|");
  EXPECT_EQ(EscapeMarkup("\u05d0\u200f – “x”"), "\u05d0\u200f – “x”") << "letters and marks of such scripts stay";
}

TEST(ScriptJson, CannotEndItsElement) {
  EXPECT_EQ(EscapeScriptJson(R"({"a":"</script><!--"})"), R"({"a":"\u003c/script>\u003c!--"})");
  EXPECT_EQ(EscapeScriptJson(R"({"a\\":"\u202e\u00e4\\u202e"})"
                             "\u2066"),
            R"({"a\\":"[U+202E]\u00e4\\u202e"}[U+2066])");
}

TEST(Markdown, KeepsATableCellInOneCell) { EXPECT_EQ(EscapeMarkdown("a|b\n*c*"), "a\\|b \\*c\\*"); }

TEST(Markdown, MakesNoFormulaAndStrikesNothingOut) {
  EXPECT_EQ(EscapeMarkdown("from $1 to $2, ~~never~~"), "from \\$1 to \\$2, \\~\\~never\\~\\~");
}

TEST(EscapeLatex, LeavesNoCharacterItsMeaning) {
  EXPECT_EQ(EscapeLatex("a_b & 50% $ # {x}"), "a\\_b \\& 50\\% \\$ \\# \\{x\\}");
  EXPECT_EQ(EscapeLatex("~^\\"), "\\textasciitilde{}\\textasciicircum{}\\textbackslash{}");
  EXPECT_EQ(EscapeLatex("[1] *--<|>"), "{}[1] *-{}-\\textless{}\\textbar{}\\textgreater{}");
  EXPECT_EQ(EscapeLatex("two\nlines"), "two lines");
  EXPECT_EQ(EscapeLatex("\n*"), "{} *");
  // For every byte, a special character comes after a backslash or belongs to our own commands.
  for (int byte = 1; byte < 256; ++byte) {
    const std::string escaped = EscapeLatex(std::string(1, static_cast<char>(byte)));
    for (const char special : {'_', '&', '%', '#'}) {
      const std::size_t at = escaped.find(special);
      EXPECT_TRUE(at == std::string::npos || (at > 0 && escaped[at - 1] == '\\')) << byte;
    }
  }
}

TEST(EscapeLatex, GivesLettersThatNoFontOfLatexHasAsNumbers) {
  EXPECT_EQ(EscapeLatex("−1.5° — “Größe” 1–2"), "$-$1.5$^\\circ$ --- ``Größe'' 1--2");
  EXPECT_EQ(EscapeLatex("中"), "{}[U+4E2D]");
  EXPECT_EQ(EscapeLatex("a 😀"), "a [U+1F600]");
  EXPECT_EQ(EscapeLatex("\xff"), "{}[U+FFFD]");
}

TEST(UrlPath, LetsNoCharacterSpeakMarkupOrLeaveTheFolder) {
  EXPECT_EQ(UrlPath("motions/a~b_1.bvh"), "motions/a~b_1.bvh");
  EXPECT_EQ(UrlPath("a b\"<é:?#%"), "a%20b%22%3C%C3%A9%3A%3F%23%25");
  EXPECT_EQ(MotionFileOf("capture/-/000/a"), "capture~-~000~a.bvh");
}

}  // namespace
}  // namespace etude
