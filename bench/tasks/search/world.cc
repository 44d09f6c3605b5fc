#include "bench/tasks/search/world.h"

#include <algorithm>

#include "engine/base/digest.h"
#include "engine/fuzzy/features.h"
#include "sim/choreography/varied_library.h"

namespace etude {
namespace {

// Makes motions piece by piece, because a pose takes twenty times the memory of its grades.
constexpr int kPiece = 50'000;
constexpr int kHeldOut = 10'000;

std::vector<BodyMotion> MotionsOf(const ClipLibrary& clips) {
  std::vector<BodyMotion> motions;
  for (const LibraryClip& clip : clips.clips) motions.push_back(clip.motion);
  return motions;
}

std::vector<Grades> MakeFrames(std::span<const BodyMotion> seeds, const FuzzySystem& fuzzy, int frames,
                               RandomStream dice) {
  std::vector<Grades> grades;
  grades.reserve(static_cast<std::size_t>(frames));
  for (int left = frames; left > 0; left -= kPiece) {
    for (const BodyMotion& motion : VariedLibrary(seeds, std::min(left, kPiece), dice)) {
      const double hip_height = StandingHipHeight(motion.poses.front());
      for (const BodyPose& pose : motion.poses) {
        grades.push_back(Fuzzify(ComputeFeatures(pose, hip_height), fuzzy.memberships));
      }
    }
  }
  return grades;
}

}  // namespace

std::string DigestOf(std::span<const Grades> frames) {
  Digest digest;
  for (const Grades& grades : frames) digest.Add(std::span<const double>(grades));
  return digest.Hex();
}

SearchLibrary MakeSearchLibrary(const ClipLibrary& clips, const FuzzySystem& fuzzy, int frames) {
  const WorldKey always{.suite_seed = 1, .scenario = "search", .trial = 0};
  const std::vector<BodyMotion> seeds = MotionsOf(clips);
  std::vector<Grades> library = MakeFrames(seeds, fuzzy, frames, RandomStream(always, "search/library"));
  std::vector<Grades> held_out = MakeFrames(seeds, fuzzy, kHeldOut, RandomStream(always, "search/held-out"));
  GradeIndex index(library, fuzzy.weights);
  std::string digest = DigestOf(library);
  return {std::move(library), std::move(held_out), std::move(index), std::move(digest)};
}

std::vector<Grades> DrawQueries(const SearchLibrary& library, int queries, const WorldKey& key) {
  RandomStream dice(key, "search/queries");
  std::vector<Grades> drawn;
  for (int i = 0; i < queries; ++i) drawn.push_back(library.held_out[dice.IndexBelow(library.held_out.size())]);
  return drawn;
}

}  // namespace etude
