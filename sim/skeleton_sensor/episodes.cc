#include "sim/skeleton_sensor/episodes.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

using enum Role;

/// A limb from its anchor outwards: an error of the guess grows along it.
struct Limb {
  std::array<Role, 4> joints;
};
constexpr std::array<Limb, 4> kLimbs = {{{{kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand}},
                                         {{kRightShoulder, kRightElbow, kRightWrist, kRightHand}},
                                         {{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot}},
                                         {{kRightHip, kRightKnee, kRightAnkle, kRightFoot}}}};
constexpr std::array<double, 4> kShareOfOffset = {0.0, 0.5, 0.9, 1.0};

/// One limb's current wrong (or lucky) idea of where its hidden joints are.
struct Episode {
  int age = 0;
  int length = 0;  // 0: none running
  bool wrong = false;
  double size_m = 0;
  glm::dvec3 direction{0};
  std::array<bool, 4> joints{};  // which were hidden since it began

  bool IsRunning() const { return length > 0; }
};

}  // namespace

std::vector<FrameGuesses> OcclusionGuesses(const BodyMotion& truth, const std::vector<HiddenJoints>& hidden,
                                           const SkeletonSensorOptions& options, const WorldKey& world) {
  RandomStream dice(world, "skeleton/occlusion");
  const double wrong_chance = std::min(1.0, options.wrong_guess_chance * options.strength);
  const int lengths = options.longest_episode - options.shortest_episode + 1;
  std::vector<FrameGuesses> guesses(truth.poses.size());
  std::array<Episode, kLimbs.size()> episodes;
  for (std::size_t t = 0; t < truth.poses.size(); ++t) {
    const BodyPose& pose = truth.poses[t];
    for (std::size_t j = 0; j < kRoleCount; ++j) guesses[t][j].inferred = hidden[t][j];

    for (std::size_t l = 0; l < kLimbs.size(); ++l) {
      const Limb& limb = kLimbs[l];
      // Thrown in every frame, used only where an episode begins.
      Episode fresh{.age = 0,
                    .length = options.shortest_episode + static_cast<int>(dice.IndexBelow(lengths)),
                    .wrong = dice.Chance(wrong_chance),
                    .size_m = options.nearest_guess_m *
                              std::pow(options.farthest_guess_m / options.nearest_guess_m, dice.Uniform()),
                    .direction = dice.Normal3(),
                    .joints = {}};

      Episode& episode = episodes[l];
      bool hides = false;
      for (std::size_t k = 1; k < limb.joints.size(); ++k) hides |= hidden[t][Index(limb.joints[k])];
      const bool seen_again = !hides && episode.age >= options.shortest_episode;
      if (episode.IsRunning() && (seen_again || episode.age >= episode.length)) episode = Episode{};
      if (!episode.IsRunning() && hides) episode = fresh;
      if (!episode.IsRunning()) continue;

      ++episode.age;
      // A guess leans towards the body: what is not seen is taken for part of what is.
      const glm::dvec3 inwards = pose[limb.joints.front()] - pose[limb.joints.back()];
      const glm::dvec3 lean = glm::normalize(inwards + glm::dvec3(0, 1e-6, 0)) + episode.direction;
      const glm::dvec3 offset = episode.wrong ? episode.size_m * glm::normalize(lean) : glm::dvec3(0);
      for (std::size_t k = 1; k < limb.joints.size(); ++k) {
        const std::size_t joint = Index(limb.joints[k]);
        episode.joints[k] |= hidden[t][joint];
        if (episode.joints[k]) guesses[t][joint] = {.inferred = true, .offset = kShareOfOffset[k] * offset};
      }
    }
  }
  return guesses;
}

JointErrors Outliers(std::size_t frames, const SkeletonSensorOptions& options, const WorldKey& world) {
  RandomStream dice(world, "skeleton/outliers");
  const double chance = std::min(1.0, options.outlier_chance * options.strength);
  JointErrors outliers(frames);
  for (auto& frame : outliers) {
    for (glm::dvec3& outlier : frame) {
      const bool strikes = dice.Chance(chance);
      const double x = dice.Uniform(-1, 1), y = dice.Uniform(-1, 1), z = dice.Uniform(-1, 1);
      outlier = strikes ? options.outlier_size_m * glm::dvec3(x, y, z) : glm::dvec3(0);
    }
  }
  return outliers;
}

std::vector<Swap> Swaps(const std::vector<double>& turns, double rate_hz, const SkeletonSensorOptions& options,
                        const WorldKey& world) {
  RandomStream dice(world, "skeleton/swaps");
  const double usual = options.swaps_per_minute * options.strength / (60.0 * rate_hz);
  const int length = static_cast<int>(rate_hz / 3.0);
  std::vector<Swap> swaps(turns.size());
  int left = 0;
  Swap current;
  for (std::size_t t = 0; t < turns.size(); ++t) {
    Swap& swap = swaps[t];
    const double chance = std::min(1.0, options.swaps_when_facing ? usual : usual * (1 - std::cos(turns[t])));
    const bool starts = dice.Chance(chance), arms = dice.Chance(0.5);
    if (left == 0 && starts) {
      left = length;
      current = {.arms = arms, .legs = !arms};
    }
    if (left > 0) {
      swap = current;
      --left;
    }
  }
  return swaps;
}

std::vector<bool> Dropouts(std::size_t frames, const SkeletonSensorOptions& options, const WorldKey& world) {
  RandomStream dice(world, "skeleton/dropouts");
  constexpr std::uint64_t kShortest = 2, kLongest = 10;  // frames (ours)
  constexpr double kMeanLength = 0.5 * (kShortest + kLongest);
  const double share = std::min(0.9, options.dropout_share * options.strength);
  const double chance = share / ((1.0 - share) * kMeanLength);  // of starting in a frame with the body seen
  std::vector<bool> lost(frames);
  std::uint64_t left = 0;
  for (std::size_t t = 0; t < frames; ++t) {
    const bool starts = dice.Chance(chance);
    const std::uint64_t length = kShortest + dice.IndexBelow(kLongest - kShortest + 1);
    if (left == 0 && starts) left = length;
    lost[t] = left > 0;
    if (left > 0) --left;
  }
  return lost;
}

}  // namespace etude
