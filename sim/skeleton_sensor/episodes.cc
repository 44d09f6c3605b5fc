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
constexpr std::array<Limb, 4> kLimbRoles = {{{{kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand}},
                                             {{kRightShoulder, kRightElbow, kRightWrist, kRightHand}},
                                             {{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot}},
                                             {{kRightHip, kRightKnee, kRightAnkle, kRightFoot}}}};
constexpr std::array<double, 4> kShareOfOffset = {0.0, 0.5, 0.9, 1.0};

// Frames that the body is lost for (ours).
constexpr std::uint64_t kShortestDropout = 2, kLongestDropout = 10;

}  // namespace

OcclusionGuesses::OcclusionGuesses(const SkeletonSensorOptions& options, const WorldKey& world)
    : options_(options), dice_(world, "skeleton/occlusion") {}

OcclusionGuesses::Episode OcclusionGuesses::Throw() {
  const double wrong_chance = std::min(1.0, options_.wrong_guess_chance * options_.strength);
  const int lengths = options_.longest_episode - options_.shortest_episode + 1;
  return {.age = 0,
          .length = options_.shortest_episode + static_cast<int>(dice_.IndexBelow(lengths)),
          .wrong = dice_.Chance(wrong_chance),
          .size_m = options_.nearest_guess_m *
                    std::pow(options_.farthest_guess_m / options_.nearest_guess_m, dice_.Uniform()),
          .direction = dice_.Normal3(),
          .joints = {}};
}

FrameGuesses OcclusionGuesses::Next(const BodyPose& pose, const HiddenJoints& hidden) {
  FrameGuesses guesses;
  for (std::size_t j = 0; j < kRoleCount; ++j) guesses[j].inferred = hidden[j];

  for (std::size_t l = 0; l < kLimbs; ++l) {
    const Limb& limb = kLimbRoles[l];
    const Episode fresh = Throw();  // in every frame, used only where an episode begins

    Episode& episode = episodes_[l];
    bool hides = false;
    for (std::size_t k = 1; k < limb.joints.size(); ++k) hides |= hidden[Index(limb.joints[k])];
    const bool seen_again = !hides && episode.age >= options_.shortest_episode;
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
      episode.joints[k] |= hidden[joint];
      if (episode.joints[k]) guesses[joint] = {.inferred = true, .offset = kShareOfOffset[k] * offset};
    }
  }
  return guesses;
}

Outliers::Outliers(const SkeletonSensorOptions& options, const WorldKey& world)
    : chance_(std::min(1.0, options.outlier_chance * options.strength)),
      size_m_(options.outlier_size_m),
      dice_(world, "skeleton/outliers") {}

FrameErrors Outliers::Next() {
  FrameErrors outliers;
  for (glm::dvec3& outlier : outliers) {
    const bool strikes = dice_.Chance(chance_);
    const double x = dice_.Uniform(-1, 1), y = dice_.Uniform(-1, 1), z = dice_.Uniform(-1, 1);
    outlier = strikes ? size_m_ * glm::dvec3(x, y, z) : glm::dvec3(0);
  }
  return outliers;
}

Swaps::Swaps(double rate_hz, const SkeletonSensorOptions& options, const WorldKey& world)
    : usual_chance_(options.swaps_per_minute * options.strength / (60.0 * rate_hz)),
      when_facing_(options.swaps_when_facing),
      length_(static_cast<int>(rate_hz / 3.0)),
      dice_(world, "skeleton/swaps") {}

Swap Swaps::Next(double turn) {
  const double chance = std::min(1.0, when_facing_ ? usual_chance_ : usual_chance_ * (1 - std::cos(turn)));
  const bool starts = dice_.Chance(chance), arms = dice_.Chance(0.5);
  if (left_ == 0 && starts) {
    left_ = length_;
    current_ = {.arms = arms, .legs = !arms};
  }
  if (left_ == 0) return {};
  --left_;
  return current_;
}

Dropouts::Dropouts(const SkeletonSensorOptions& options, const WorldKey& world) : dice_(world, "skeleton/dropouts") {
  constexpr double kMeanLength = 0.5 * (kShortestDropout + kLongestDropout);
  const double share = std::min(0.9, options.dropout_share * options.strength);
  chance_ = share / ((1.0 - share) * kMeanLength);
}

bool Dropouts::Next() {
  const bool starts = dice_.Chance(chance_);
  const std::uint64_t length = kShortestDropout + dice_.IndexBelow(kLongestDropout - kShortestDropout + 1);
  if (left_ == 0 && starts) left_ = length;
  if (left_ == 0) return false;
  --left_;
  return true;
}

}  // namespace etude
