#include "engine/base/base64.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

// RFC 4648, section 10.
TEST(Base64, GivesThePublishedVectors) {
  EXPECT_EQ(Base64(std::string_view()), "");
  EXPECT_EQ(Base64(std::string_view("f")), "Zg==");
  EXPECT_EQ(Base64(std::string_view("fo")), "Zm8=");
  EXPECT_EQ(Base64(std::string_view("foo")), "Zm9v");
  EXPECT_EQ(Base64(std::string_view("foob")), "Zm9vYg==");
  EXPECT_EQ(Base64(std::string_view("foobar")), "Zm9vYmFy");
  EXPECT_EQ(Base64(std::string_view("\xff\xef\xfe")), "/+/+");
}

}  // namespace
}  // namespace etude
