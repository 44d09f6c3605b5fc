#include <gtest/gtest.h>

#include <string>

#include "engine/formats/gltf/file.h"

namespace etude {
namespace {

/// Well-formed sequences of two bytes and more: the first and last of every row of the Unicode standard's table 3-7.
TEST(GltfText, KeepsWhatTheUnicodeStandardCallsWellFormed) {
  for (const std::string text :
       {"\xC2\xA0", "\xDF\xBF", "\xE0\xA0\x80", "\xE0\xBF\xBF", "\xE1\x80\x80", "\xEC\xBF\xBF", "\xED\x80\x80",
        "\xED\x9F\xBF", "\xEE\x80\x80", "\xEF\xBF\xBF", "\xF0\x90\x80\x80", "\xF0\xBF\xBF\xBF", "\xF1\x80\x80\x80",
        "\xF3\xBF\xBF\xBF", "\xF4\x80\x80\x80", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_EQ(GltfText(text), text) << ::testing::PrintToString(text);
    EXPECT_EQ(GltfText("a" + text + "b"), "a" + text + "b");
  }
}

TEST(GltfText, ReplacesEveryByteOfWhatLiesJustBeyond) {
  for (const std::string text :
       {"\xC1\xBF", "\xC2\x80", "\xC2\x9F", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80",
        "\xF5\x80\x80\x80", "\xE1\x7F", "\xE1\xC0", "\xE1\x80", "\x1F", "\x7F"}) {
    std::string expected;
    for (char byte : text) expected += byte >= 0x20 && byte < 0x7F ? byte : '?';
    // 0x7F is a control character below 0x80.
    EXPECT_EQ(GltfText(text), expected) << ::testing::PrintToString(text);
  }
}

}  // namespace
}  // namespace etude
