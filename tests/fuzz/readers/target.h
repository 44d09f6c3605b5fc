#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/base/result.h"

namespace etude::fuzz {

/// The file name in error messages.
inline const std::string kFile = "fuzzed";

struct Target {
  std::string name;
  /// Reads `bytes` as if a user had given them, and always returns. If the reader accepts them, our own writer must
  /// write them so that the reader accepts them again (Require).
  void (*read)(std::string_view bytes);
  /// Returns good inputs, made by the program, from which mutations start.
  std::vector<std::string> (*seeds)();
  /// Words of the format that no good input contains, for the fuzzer's dictionary.
  std::vector<std::string> words = {};
};

std::vector<Target> MotionTargets();
std::vector<Target> FbxTargets();
std::vector<Target> StreamTargets();
std::vector<Target> CameraTargets();
std::vector<Target> SettingTargets();
std::vector<Target> RunTargets();
std::vector<Target> AnswerTargets();
const std::vector<Target>& Targets();

/// Unless `holds`, ends the program with the message `broken`.
void Require(bool holds, const char* broken);
/// Returns the value of a Result that must have one; otherwise ends the program with the error.
template <typename T>
decltype(auto) Required(const Result<T>& result, const char* broken) {
  if (!result) Require(false, (std::string(broken) + ": " + ToString(result.error())).c_str());
  if constexpr (!std::is_void_v<T>) return *result;
}

/// For texts that a reader accepts: writes the value that was read, reads the written text again, and requires that
/// writing gives the same bytes.
template <typename Read, typename Write>
void RequireRoundTrip(std::string_view bytes, const Read& read, const Write& write) {
  const auto once = read(bytes);
  if (!once) {
    ToString(once.error());
    return;
  }
  const std::string text = write(*once);
  const auto twice = read(text);
  Required(twice, "what was written is not read");
  Require(write(*twice) == text, "what was read is written otherwise the second time");
}

/// Returns the texts of the tree's files whose names end with `ending`; `folder` is relative to the root, where tests
/// run.
std::vector<std::string> FilesOf(const std::string& folder, std::string_view ending);

}  // namespace etude::fuzz
