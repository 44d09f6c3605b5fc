#include "sim/sensors/skeleton_errors.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

using enum Role;

const JointErrorSizes& SizesOf(Role role, const SkeletonSensorOptions& options) {
  switch (role) {
    case kLeftElbow:
    case kRightElbow:
    case kLeftKnee:
    case kRightKnee:
      return options.middle;
    case kLeftWrist:
    case kRightWrist:
    case kLeftHand:
    case kRightHand:
    case kLeftAnkle:
    case kRightAnkle:
    case kLeftFoot:
    case kRightFoot:
      return options.ends;
    default:
      return options.torso;
  }
}

/// A random vector field, smooth in space and time: each axis is close to a standard normal variable,
/// with correlation exp(−r²/2ℓ²) over distance and exp(−t²/2τ²) over time. (A sum of random waves.)
class SmoothField {
 public:
  SmoothField(RandomStream& random, double length_m, double time_s) {
    for (Wave& wave : waves_) {
      wave.direction = random.Normal3() * std::sqrt(2.0 / kWaves);
      wave.per_metre = random.Normal3() / length_m;
      wave.per_second = random.Normal() / time_s;
      wave.phase = random.Uniform(0, 2 * kPi);
    }
  }

  glm::dvec3 At(const glm::dvec3& place, double time_s) const {
    glm::dvec3 sum(0);
    for (const Wave& wave : waves_) {
      sum += wave.direction * std::cos(glm::dot(wave.per_metre, place) + wave.per_second * time_s + wave.phase);
    }
    return sum;
  }

 private:
  static constexpr int kWaves = 12;
  struct Wave {
    glm::dvec3 direction, per_metre;
    double per_second, phase;
  };
  std::array<Wave, kWaves> waves_;
};

/// Metres per second over the neighbouring frames.
double SpeedAt(const BodyMotion& motion, std::size_t frame, std::size_t joint) {
  const std::size_t before = frame >= 2 ? frame - 2 : 0;
  const std::size_t after = std::min(frame + 2, motion.poses.size() - 1);
  if (after == before) return 0;
  const double seconds = static_cast<double>(after - before) / motion.rate_hz;
  return glm::distance(motion.poses[after].joints[joint], motion.poses[before].joints[joint]) / seconds;
}

double BodySpeedAt(const BodyMotion& motion, std::size_t frame) {
  double sum = 0;
  for (std::size_t j = 0; j < kRoleCount; ++j) sum += SpeedAt(motion, frame, j);
  return sum / kRoleCount;
}

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

std::vector<std::array<glm::dvec3, kRoleCount>> ContinuousErrors(const BodyMotion& truth,
                                                                 const SkeletonSensorOptions& options,
                                                                 const WorldKey& world) {
  RandomStream wander_dice(world, "skeleton/wander");
  RandomStream place_dice(world, "skeleton/place-error");
  RandomStream speed_dice(world, "skeleton/speed-error");
  const SmoothField by_place(place_dice, options.correlation_length_m, 1e9);
  const SmoothField by_speed(speed_dice, options.correlation_length_m, options.correlation_time_s);

  const double memory = std::exp(-1.0 / (truth.rate_hz * options.correlation_time_s));
  const double renewal = std::sqrt(1.0 - memory * memory);
  // Of the moving error's variance, this share is there at any speed, the rest grows with speed (ours).
  constexpr double kPlaceShare = 0.6;
  constexpr double kFullSpeed = 0.5;  // m/s at which the rest is reached
  constexpr double kSpeedCap = 1.6;   // times kFullSpeed: no further growth

  std::vector<std::array<glm::dvec3, kRoleCount>> errors(truth.poses.size());
  std::array<glm::dvec3, kRoleCount> wander;
  for (glm::dvec3& start : wander) start = wander_dice.Normal3();
  for (std::size_t t = 0; t < truth.poses.size(); ++t) {
    const double seconds = static_cast<double>(t) / truth.rate_hz;
    const double body_speed = BodySpeedAt(truth, t);
    for (Role role : AllRoles()) {
      const std::size_t j = Index(role);
      const JointErrorSizes& sizes = SizesOf(role, options);
      wander[j] = memory * wander[j] + renewal * wander_dice.Normal3();
      const glm::dvec3 white = wander_dice.Normal3();

      // A joint that rests on a moving body is not seen as well as one that rests on a resting body.
      const double speed = std::min(0.5 * (SpeedAt(truth, t, j) + body_speed) / kFullSpeed, kSpeedCap);
      const double per_axis = sizes.moving / std::sqrt(3.0);
      const glm::dvec3& place = truth.poses[t].joints[j];
      const glm::dvec3 moving = per_axis * (std::sqrt(kPlaceShare) * by_place.At(place, 0) +
                                            std::sqrt(1 - kPlaceShare) * speed * by_speed.At(place, seconds));
      errors[t][j] = options.strength * (sizes.still * wander[j] + sizes.white * white + moving);
    }
  }
  return errors;
}

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

std::vector<std::array<glm::dvec3, kRoleCount>> Outliers(std::size_t frames, const SkeletonSensorOptions& options,
                                                         const WorldKey& world) {
  RandomStream dice(world, "skeleton/outliers");
  const double chance = std::min(1.0, options.outlier_chance * options.strength);
  std::vector<std::array<glm::dvec3, kRoleCount>> outliers(frames);
  for (auto& frame : outliers) {
    for (glm::dvec3& outlier : frame) {
      const bool strikes = dice.Chance(chance);
      const double x = dice.Uniform(-1, 1), y = dice.Uniform(-1, 1), z = dice.Uniform(-1, 1);
      outlier = strikes ? options.outlier_size_m * glm::dvec3(x, y, z) : glm::dvec3(0);
    }
  }
  return outliers;
}

std::vector<Swap> Swaps(std::size_t frames, double rate_hz, const SkeletonSensorOptions& options,
                        const WorldKey& world) {
  RandomStream dice(world, "skeleton/swaps");
  const double chance = std::min(1.0, options.swaps_per_minute * options.strength / (60.0 * rate_hz));
  const int length = static_cast<int>(rate_hz / 3.0);
  std::vector<Swap> swaps(frames);
  int left = 0;
  Swap current;
  for (Swap& swap : swaps) {
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
