#include "bench/micro/seeds.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "io/clips/clip_library.h"
#include "io/clips/references.h"

namespace etude {

std::vector<SeedClip> LoadSeeds(const std::vector<std::string>& files) {
  std::vector<std::string> references = files;
  if (files.empty()) {
    for (const char* name : {"01_01", "01_03", "Boxing_Toes"}) {
      const std::string path = std::string("/usr/share/assimp/models/BVH/") + name + ".bvh";
      if (std::filesystem::exists(path)) references.push_back(path);
    }
  }
  for (const std::string& name : BuiltinMoveNames()) references.push_back(std::string(kBuiltinPrefix) + name);
  for (const std::string& name : BuiltinActNames()) references.push_back(std::string(kBuiltinPrefix) + name);
  const auto library = LoadClips(references, {});
  if (!library) {
    std::fprintf(stderr, "%s\n", ToString(library.error()).c_str());
    std::exit(2);
  }
  std::vector<SeedClip> seeds;
  for (const LibraryClip& clip : library->clips) {
    seeds.push_back({clip.name, clip.motion});
  }
  return seeds;
}

}  // namespace etude
