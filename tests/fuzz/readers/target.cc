#include "tests/fuzz/readers/target.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace etude::fuzz {

const std::vector<Target>& Targets() {
  static const std::vector<Target> targets = [] {
    std::vector<Target> all;
    for (const auto& part : {MotionTargets(), FbxTargets(), StreamTargets(), CameraTargets(), SettingTargets(),
                             RunTargets(), AnswerTargets()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return targets;
}

void Require(bool holds, const char* broken) {
  if (holds) return;
  std::fprintf(stderr, "BROKEN PROMISE: %s\n", broken);
  std::abort();
}

std::vector<std::string> FilesOf(const std::string& folder, std::string_view ending) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().string().ends_with(ending)) paths.push_back(entry.path());
  }
  std::ranges::sort(paths);
  std::vector<std::string> texts;
  for (const auto& path : paths) {
    std::ifstream in(path, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return texts;
}

}  // namespace etude::fuzz
