#include "bench/micro/bridge_search_data.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "engine/fuzzy/features.h"
#include "io/clips/clip_library.h"
#include "io/clips/references.h"
#include "sim/choreography/varied_library.h"

namespace etude {
namespace {

constexpr int kQueries = 100;

std::vector<Grades> GradesOf(const BodyMotion& motion) {
  std::vector<Grades> grades;
  const double hip_height = StandingHipHeight(motion.poses.front());
  for (const BodyPose& pose : motion.poses) grades.push_back(Fuzzify(ComputeFeatures(pose, hip_height)));
  return grades;
}

/// Makes the poses in parts and keeps only their grades, because poses are large.
std::vector<std::vector<Grades>> VaryGrades(std::span<const BodyMotion> seeds, int count, RandomStream& stream) {
  constexpr int kPartFrames = 50'000;
  std::vector<std::vector<Grades>> clips;
  for (int done = 0; done < count; done += kPartFrames) {
    for (const BodyMotion& clip : VariedLibrary(seeds, std::min(kPartFrames, count - done), stream)) {
      clips.push_back(GradesOf(clip));
    }
  }
  return clips;
}

std::vector<Grades> Joined(std::span<const std::vector<Grades>> clips) {
  std::vector<Grades> all;
  for (const std::vector<Grades>& clip : clips) all.insert(all.end(), clip.begin(), clip.end());
  return all;
}

std::vector<Grades> Spread(std::span<const Grades> frames) {
  std::vector<Grades> some;
  for (std::size_t i = 0; i < kQueries; ++i) some.push_back(frames[i * frames.size() / kQueries]);
  return some;
}

bool IsForeign(std::size_t seed) { return seed % 5 == 1; }

}  // namespace

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
    seeds.push_back({clip.name, !clip.name.starts_with(kBuiltinPrefix), clip.motion});
  }
  return seeds;
}

std::string DescribeSeeds(std::span<const SeedClip> seeds) {
  std::string text;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const std::string seed = seeds[i].name + " " + std::to_string(seeds[i].motion.poses.size());
    text += (i == 0 ? "" : ", ") + (IsForeign(i) ? "[" + seed + "]" : seed);
  }
  return text;
}

SearchData MakeSearchData(std::span<const SeedClip> seeds, int count) {
  std::vector<BodyMotion> known, foreign;
  for (std::size_t i = 0; i < seeds.size(); ++i) (IsForeign(i) ? foreign : known).push_back(seeds[i].motion);
  const WorldKey world{.suite_seed = 1, .scenario = "bridge_search_bench", .trial = 0};
  RandomStream library_dice(world, "library"), varied_dice(world, "varied"), foreign_dice(world, "foreign");
  SearchData data;
  data.clips = VaryGrades(known, count, library_dice);
  data.frames = Joined(data.clips);
  data.own = Spread(data.frames);
  data.varied = Spread(Joined(VaryGrades(known, 20'000, varied_dice)));
  data.foreign = Spread(Joined(VaryGrades(foreign, 20'000, foreign_dice)));
  return data;
}

SearchData MakeCapturedData(std::span<const SeedClip> seeds) {
  SearchData data;
  std::vector<Grades> foreign;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (!seeds[i].captured) continue;
    std::vector<Grades> grades = GradesOf(seeds[i].motion);
    if (IsForeign(i)) {
      foreign.insert(foreign.end(), grades.begin(), grades.end());
    } else {
      data.clips.push_back(std::move(grades));
    }
  }
  data.frames = Joined(data.clips);
  if (!data.frames.empty()) data.own = Spread(data.frames);
  if (!foreign.empty()) data.foreign = Spread(foreign);
  return data;
}

std::vector<std::vector<Grades>> ClipsOfLength(std::span<const Grades> frames, std::size_t length) {
  std::vector<std::vector<Grades>> clips;
  for (std::size_t i = 0; i + length <= frames.size(); i += length) {
    clips.emplace_back(frames.begin() + i, frames.begin() + i + length);
  }
  return clips;
}

}  // namespace etude
