#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/base/result.h"

namespace etude::fuzz {

/// What complaints call what is read.
inline const std::string kFile = "fuzzed";

/// A reader under attack.
struct Target {
  std::string name;
  /// Reads `bytes` as if a user had given them. Whatever they are, it returns; what it has taken, our own writer writes
  /// so that it is taken again (Require).
  void (*read)(std::string_view bytes);
  /// Good inputs, made by the program: what mutations start from.
  std::vector<std::string> (*seeds)();
  /// Words of the format that no seed has, for the fuzzer's dictionary.
  std::vector<std::string> words = {};
};

std::vector<Target> MotionTargets();
std::vector<Target> FbxTargets();
std::vector<Target> StreamTargets();
std::vector<Target> CameraTargets();
std::vector<Target> SettingTargets();
std::vector<Target> RunTargets();
std::vector<Target> AnswerTargets();
/// All of them.
const std::vector<Target>& Targets();

/// Ends the program, saying `broken`, unless `holds`.
void Require(bool holds, const char* broken);
/// What must have been read or written; else ends the program, saying why it was not.
template <typename T>
decltype(auto) Required(const Result<T>& result, const char* broken) {
  if (!result) Require(false, (std::string(broken) + ": " + ToString(result.error())).c_str());
  if constexpr (!std::is_void_v<T>) return *result;
}

/// Of texts that a reader takes and a writer writes: what was read is written, that is read again, and written as the
/// same bytes.
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

/// The texts of files of the tree whose names end so; `folder` from its root, where tests run.
std::vector<std::string> FilesOf(const std::string& folder, std::string_view ending);

}  // namespace etude::fuzz
