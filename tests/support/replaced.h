#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace etude::testing {

/// Returns `text` with the first `from` replaced; fails the test if there is none.
inline std::string Replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result(text);
  const std::size_t at = result.find(from);
  EXPECT_NE(at, std::string::npos) << "no '" << from << "' in the text";
  if (at != std::string::npos) result.replace(at, from.size(), to);
  return result;
}

}  // namespace etude::testing
