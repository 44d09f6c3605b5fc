#include "engine/base/utf8.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <string>

namespace etude {
namespace {

using ::testing::HasSubstr;

std::string Utf8Complaint(std::string_view text) {
  const auto checked = CheckUtf8(text, "file");
  return checked ? "" : ToString(checked.error());
}

/// The table of RFC 3629, section 3, written out.
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
  EXPECT_EQ(Utf8Complaint("a: größe\nb: c\n"), "");
  EXPECT_THAT(Utf8Complaint("a: größe\nb: \xff\n"), HasSubstr("file:2:4: byte 0xff is no UTF-8"));
  EXPECT_THAT(Utf8Complaint("größe \xc3"), HasSubstr("file:1:7: byte 0xc3")) << "columns count characters";
  EXPECT_THAT(Utf8Complaint("\xff\xfe"
                        "a"),
              HasSubstr("file:1:1: byte 0xff"))
      << "UTF-16";
  EXPECT_THAT(Utf8Complaint(std::string_view("a\0", 2)), HasSubstr("file:1:2: byte 0x00"));
  EXPECT_NE(Utf8Complaint("\xc0\xaf"), "") << "overlong";
  EXPECT_NE(Utf8Complaint("\xe0\x80\xaf"), "") << "overlong";
  EXPECT_NE(Utf8Complaint("\xf0\x80\x80\xaf"), "") << "overlong";
  EXPECT_NE(Utf8Complaint("\xe2\x82"), "") << "cut off";
}

}  // namespace
}  // namespace etude
