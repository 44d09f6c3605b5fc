#pragma once

#include <gtest/gtest.h>

#include <string>

#include "engine/base/result.h"

namespace etude::testing {

using namespace ::testing;  // so that `testing::HasSubstr` is found in every unity build

/// Returns the error of a Result that has no value; "" for other types.
template <typename T>
std::string WhyNone(const T& result) {
  if constexpr (requires { ToString(result.error()); }) return ToString(result.error());
  return "";
}

/// Returns the error of a Result, "place: message"; "accepted" if there is none.
template <typename T>
std::string Refusal(const Result<T>& result) {
  return result ? "accepted" : ToString(result.error());
}

/// Returns the error's message without the place.
template <typename T>
std::string Message(const Result<T>& result) {
  return result ? "accepted" : result.error().message;
}

}  // namespace etude::testing

/// Declares a constant from a Result. If it has no value, the test ends: `ASSERT_OK(clip, ReadBvh(text, "a.bvh"));`
#define ASSERT_OK(name, ...)       \
  const auto name = (__VA_ARGS__); \
  ASSERT_TRUE(name) << ::etude::testing::WhyNone(name)
