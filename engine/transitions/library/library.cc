#include "engine/transitions/library/library.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/order_statistics.h"
#include "engine/motion/pendulum.h"
#include "engine/motion/support.h"

namespace etude {
namespace {

constexpr std::array kEnds = {Role::kLeftFoot, Role::kRightFoot, Role::kLeftHand, Role::kRightHand};
constexpr std::size_t kVectorCount = kMotionFeatureCount / 3;
static_assert(kVectorCount == 2 * kEnds.size() + 1);

MotionFeatures FeaturesAt(const BodyMotion& motion, int frame) {
  const int last = static_cast<int>(motion.poses.size()) - 1;
  const int before = std::max(frame - 1, 0), after = std::min(frame + 1, last);
  const double seconds = std::max(after - before, 1) / motion.rate_hz;
  const FloorMove to_origin = ToOrigin(motion.poses[frame]);
  const FloorMove turn{.yaw = to_origin.yaw};
  const auto velocity = [&](Role role) {
    return turn.Apply((motion.poses[after][role] - motion.poses[before][role]) / seconds);
  };

  // Append positions and velocities of feet and hands, then the velocity of the hips.
  MotionFeatures features{};
  auto next = features.begin();
  const auto append = [&](const glm::dvec3& v) {
    for (int axis = 0; axis < 3; ++axis) *next++ = v[axis];
  };
  for (Role end : kEnds) append(to_origin.Apply(motion.poses[frame][end]));
  for (Role end : kEnds) append(velocity(end));
  append(velocity(Role::kHipCentre));
  return features;
}

/// Returns the standard deviation of each vector over all frames: the square root of the mean variance of the vector's
/// three coordinates.
std::array<double, kVectorCount> Spreads(const std::vector<std::vector<MotionFeatures>>& clips) {
  MotionFeatures means{};
  double count = 0;
  for (const auto& frames : clips) {
    count += static_cast<double>(frames.size());
    for (const MotionFeatures& features : frames) {
      for (std::size_t i = 0; i < kMotionFeatureCount; ++i) means[i] += features[i];
    }
  }
  for (double& mean : means) mean /= std::max(count, 1.0);
  std::array<double, kVectorCount> spreads{};
  for (const auto& frames : clips) {
    for (const MotionFeatures& features : frames) {
      for (std::size_t i = 0; i < kMotionFeatureCount; ++i) {
        const double off = features[i] - means[i];
        spreads[i / 3] += off * off;
      }
    }
  }
  for (double& spread : spreads) spread = std::sqrt(spread / std::max(3 * count, 1.0));
  return spreads;
}

}  // namespace

double SquaredDistance(const MotionFeatures& a, const MotionFeatures& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

std::vector<std::vector<MotionFeatures>> ComputeMotionFeatures(std::span<const BodyMotion> clips) {
  std::vector<std::vector<MotionFeatures>> computed;
  computed.reserve(clips.size());
  for (const BodyMotion& motion : clips) {
    auto& frames = computed.emplace_back();
    frames.reserve(motion.poses.size());
    for (int f = 0; f < static_cast<int>(motion.poses.size()); ++f) frames.push_back(FeaturesAt(motion, f));
  }
  const std::array<double, kVectorCount> spreads = Spreads(computed);
  constexpr double kNoSpread = 1e-9;  // smaller values are rounding errors, not movement
  for (auto& frames : computed) {
    for (MotionFeatures& features : frames) {
      for (std::size_t i = 0; i < kMotionFeatureCount; ++i) {
        features[i] = spreads[i / 3] < kNoSpread ? 0 : features[i] / spreads[i / 3];
      }
    }
  }
  return computed;
}

double UsualAcceleration(const BodyMotion& motion) {
  constexpr double kUsual = 0.9;
  std::vector<double> largest;
  for (std::size_t f = 1; f + 1 < motion.poses.size(); ++f) {
    double& here = largest.emplace_back(0);
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const auto at = [&](std::size_t frame) { return motion.poses[frame].joints[j]; };
      here = std::max(here, glm::length(at(f + 1) - 2.0 * at(f) + at(f - 1)));
    }
  }
  return largest.empty() ? 0 : LowerPercentile(std::move(largest), kUsual);
}

Stance StanceOf(const BodyPose& pose, double standing_hip_height) {
  constexpr double kBeside = 0.25, kLow = 0.6;
  static const JointSet kFeet = [] {
    JointSet feet;
    for (Role role : {Role::kLeftAnkle, Role::kRightAnkle, Role::kLeftFoot, Role::kRightFoot}) feet.set(Index(role));
    return feet;
  }();
  double lowest = pose.joints[0].y;
  for (const glm::dvec3& joint : pose.joints) lowest = std::min(lowest, joint.y);
  const double hips = pose[Role::kHipCentre].y - lowest;
  return {.is_down = hips <= kLow * standing_hip_height && *BalanceOffset(pose, kFeet) > kBeside, .hips = hips};
}

bool NeedsClip(const Stance& a, const Stance& b) {
  constexpr double kMaxRise = 0.2;
  return (a.is_down || b.is_down) && std::abs(a.hips - b.hips) > kMaxRise;
}

std::vector<double> ZeroMomentOffsets(const BodyMotion& motion) {
  const int last = static_cast<int>(motion.poses.size()) - 1;
  std::vector<glm::dvec3> centres;
  for (const BodyPose& pose : motion.poses) centres.push_back(MassCentre(pose));
  const std::vector<Bearing> bearing = FindBearing(motion.poses, motion.rate_hz);
  std::vector<double> offsets(motion.poses.size());
  for (int f = 0; f <= last; ++f) {
    offsets[f] = ZeroMomentOffset(centres, f, motion.rate_hz, motion.poses[f], bearing[f].bears).value_or(0);
  }
  return offsets;
}

MotionLibrary MakeLibraryOfOneBody(std::vector<std::string> names, std::vector<BodyMotion> motions,
                                   const BodyProportions& proportions, const TagRules& rules, const TweenRules& tween) {
  MotionLibrary library;
  library.proportions = proportions;
  library.names = std::move(names);
  library.motions = std::move(motions);
  library.tagged = TagClips(library.motions, proportions.standing_hip_height, rules);
  library.features = ComputeMotionFeatures(library.motions);
  for (const BodyMotion& motion : library.motions) {
    library.usual_accelerations.push_back(UsualAcceleration(motion));
    library.beside_feet.push_back(ZeroMomentOffsets(motion));
    std::vector<Stance>& stances = library.stances.emplace_back();
    for (const BodyPose& pose : motion.poses) stances.push_back(StanceOf(pose, proportions.standing_hip_height));
  }
  library.in_betweens =
      BuildInBetweens(library.tagged, {.weights = rules.weights, .threshold = kPaperThreshold, .tween = tween});
  return library;
}

MotionLibrary MakeLibrary(std::vector<std::string> names, std::span<const BodyMotion> clips,
                          const BodyProportions& proportions, const TagRules& rules, const TweenRules& tween) {
  return MakeLibraryOfOneBody(std::move(names), PerformedBy(proportions, clips), proportions, rules, tween);
}

}  // namespace etude
