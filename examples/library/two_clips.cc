// Prints fuzzy features and bridge frames of two BVH files: two_clips WALK.bvh DANCE.bvh
#include <etude/fuzzy.h>

#include <cstdio>
#include <fstream>
#include <iterator>

using namespace etude::engine;

int main(int count, char** names) try {
  if (count != 3) throw BadInput("two_clips FROM.bvh TO.bvh");
  std::vector<Motion> clips;
  for (int i = 1; i < count; ++i) {
    std::ifstream file(names[i], std::ios::binary);
    clips.push_back(ReadMotion(std::string(std::istreambuf_iterator<char>(file), {}), names[i]));
  }

  const PoseFeatures from = ComputeFeatures(clips[0]).front(), to = ComputeFeatures(clips[1]).front();
  for (const Feature feature : AllFeatures()) {
    std::printf("%-8s %6.1f %6.1f\n", std::string(FeatureName(feature)).c_str(), from[feature], to[feature]);
  }
  std::printf("fuzzy distance of the first frames: %.3f\n", FuzzyDistance(from, to));

  const Bridges bridges(clips);
  std::printf("bridge frames: %zu and %zu\n", bridges.FramesOf(0).size(), bridges.FramesOf(1).size());
  const double whole_clip_s = double(clips[0].poses.size()) / clips[0].rate_hz;
  if (const auto point = bridges.Find(0, 0, 1, whole_clip_s)) {
    std::printf("leave at frame %d, enter at frame %d: distance %.3f\n", point->from, point->to, point->distance);
  }
} catch (const BadInput& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
