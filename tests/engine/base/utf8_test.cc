#include "engine/base/utf8.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <string>

#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

std::string Utf8Complaint(std::string_view text) { return testing::Refusal(CheckUtf8(text, "file")); }

/// Encodes by the table of RFC 3629, section 3.
std::string Encoded(std::uint32_t c) {
  const auto byte = [](std::uint32_t value) { return std::string(1, static_cast<char>(value)); };
  if (c < 0x80) return byte(c);
  if (c < 0x800) return byte(0xc0 | c >> 6) + byte(0x80 | (c & 0x3f));
  if (c < 0x10000) return byte(0xe0 | c >> 12) + byte(0x80 | (c >> 6 & 0x3f)) + byte(0x80 | (c & 0x3f));
  return byte(0xf0 | c >> 18) + byte(0x80 | (c >> 12 & 0x3f)) + byte(0x80 | (c >> 6 & 0x3f)) + byte(0x80 | (c & 0x3f));
}

TEST(CheckUtf8, TakesEveryCharacterAndNoSurrogate) {
  for (std::uint32_t c = 1; c <= 0x10ffff; ++c) {
    const bool is_surrogate = c >= 0xd800 && c <= 0xdfff;
    ASSERT_EQ(CheckUtf8(Encoded(c), "file").has_value(), !is_surrogate) << c;
  }
  EXPECT_FALSE(CheckUtf8(Encoded(0x110000), "file"));
}

TEST(CheckUtf8, NamesThePlaceOfTheFirstWrongByte) {
  EXPECT_EQ(Utf8Complaint("a: größe\nb: c\n"), "accepted");
  EXPECT_THAT(Utf8Complaint("a: größe\nb: \xff\n"), HasSubstr("file:2:4: byte 0xff is not UTF-8"));
  EXPECT_THAT(Utf8Complaint("größe \xc3"), HasSubstr("file:1:7: byte 0xc3")) << "columns count characters";
  EXPECT_THAT(Utf8Complaint("\xff\xfe"
                            "a"),
              HasSubstr("file:1:1: byte 0xff"))
      << "UTF-16";
  EXPECT_THAT(Utf8Complaint(std::string_view("a\0", 2)), HasSubstr("file:1:2: byte 0x00"));
}

TEST(FirstCharacter, IsReadWithItsNumber) {
  for (std::uint32_t c = 0; c <= 0x10ffff; ++c) {
    if (c >= 0xd800 && c <= 0xdfff) continue;
    const std::string text = Encoded(c) + "x";
    const Utf8Character read = FirstCharacter(text);
    ASSERT_EQ(read.code, c);
    ASSERT_EQ(read.length, text.size() - 1);
  }
  for (const char* none : {"\xff", "\xc3", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe0\x80\x80"}) {
    EXPECT_EQ(FirstCharacter(none).length, 0u);
  }
}

TEST(Visible, ShowsWhatIsHiddenAndCommandsNoTerminal) {
  EXPECT_EQ(Visible("größer → 5 °, 𝄞"), "größer → 5 °, 𝄞");
  EXPECT_EQ(Visible("exe.\u202efdp"), "exe.[U+202E]fdp");
  for (const std::uint32_t c :
       {0x80U, 0x9bU, 0x200bU, 0x200fU, 0x202aU, 0x202eU, 0x2066U, 0x2069U, 0xfeffU, 0xe0041U, 0x34fU, 0x115fU, 0x3164U, 0xfe0fU, 0x1d173U, 0xe0100U}) {
    EXPECT_EQ(Visible("a" + Encoded(c) + "b"), "a" + NumberOf(c) + "b");
  }
  EXPECT_EQ(Visible("\x1b[2Ja\r\nb\tc\x7f"), " [2Ja  b c ");
  EXPECT_EQ(Visible("a\nb\tc\r", "\n\t"), "a\nb\tc ");
  EXPECT_EQ(Visible("\xff\xc3"), "\ufffd\ufffd");
}

TEST(Errors, ShowNoNameAsAnother) {
  EXPECT_EQ(ToString(Error{{"a\u202eb", 3, 0}, "found \u2066c\x1b[1m"}), "a[U+202E]b:3: found [U+2066]c [1m");
}

}  // namespace
}  // namespace etude
