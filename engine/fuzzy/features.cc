#include "engine/fuzzy/features.h"

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/named.h"

namespace etude {
namespace {

using enum Role;
using enum Feature;

struct FeatureFacts {
  Feature feature;
  std::string_view name;
  std::span<const Role> joints;
};

// The angles of upper arms and thighs are measured against the trunk, so they also depend on hips and shoulders.
constexpr std::array kRightArmRaise = {kRightShoulder, kRightElbow, kLeftShoulder, kLeftHip, kRightHip};
constexpr std::array kLeftArmRaise = {kLeftShoulder, kLeftElbow, kRightShoulder, kLeftHip, kRightHip};
constexpr std::array kRightElbowBend = {kRightShoulder, kRightElbow, kRightWrist};
constexpr std::array kLeftElbowBend = {kLeftShoulder, kLeftElbow, kLeftWrist};
constexpr std::array kBodyHeight = {kHipCentre};
constexpr std::array kLean = {kLeftShoulder, kRightShoulder, kLeftHip, kRightHip};
constexpr std::array kRightLegSpread = {kRightHip, kRightKnee, kLeftHip, kLeftShoulder, kRightShoulder};
constexpr std::array kLeftLegSpread = {kLeftHip, kLeftKnee, kRightHip, kLeftShoulder, kRightShoulder};
constexpr std::array kRightKneeBend = {kRightHip, kRightKnee, kRightAnkle};
constexpr std::array kLeftKneeBend = {kLeftHip, kLeftKnee, kLeftAnkle};

constexpr std::array<FeatureFacts, kFeatureCount> kFacts = {{
    {kRH, "RH", kRightArmRaise},
    {kLH, "LH", kLeftArmRaise},
    {kRHE, "RHE", kRightElbowBend},
    {kLHE, "LHE", kLeftElbowBend},
    {kPosture, "Posture", kBodyHeight},
    {kTrunk, "Trunk", kLean},
    {kRF, "RF", kRightLegSpread},
    {kLF, "LF", kLeftLegSpread},
    {kRFK, "RFK", kRightKneeBend},
    {kLFK, "LFK", kLeftKneeBend},
}};

constexpr std::array<Feature, kFeatureCount> kFeatures = [] {
  std::array<Feature, kFeatureCount> features{};
  for (std::size_t i = 0; i < kFeatureCount; ++i) features[i] = kFacts[i].feature;
  return features;
}();

/// Returns the inner angle at the knee; a limb of zero length counts as straight.
double KneeDegrees(const glm::dvec3& hip, const glm::dvec3& knee, const glm::dvec3& ankle) {
  return 180.0 - Degrees(AngleBetween(knee - hip, ankle - knee));
}

}  // namespace

std::span<const Feature, kFeatureCount> AllFeatures() { return kFeatures; }

std::string_view FeatureName(Feature feature) { return kFacts[static_cast<std::size_t>(feature)].name; }

const Feature* FindFeature(std::string_view name) {
  const FeatureFacts* facts = FindByName(kFacts, name);
  return facts != nullptr ? &facts->feature : nullptr;
}

std::span<const Role> JointsOf(Feature feature) { return kFacts[static_cast<std::size_t>(feature)].joints; }

PoseFeatures ComputeFeatures(const BodyPose& pose, double standing_hip_height) {
  const glm::dvec3 mid_hips = 0.5 * (pose[kLeftHip] + pose[kRightHip]);
  const glm::dvec3 mid_shoulders = 0.5 * (pose[kLeftShoulder] + pose[kRightShoulder]);
  const glm::dvec3 trunk = mid_shoulders - mid_hips;
  const glm::dvec3 down = -trunk;
  const auto limb = [&](Role from, Role to) { return pose[to] - pose[from]; };
  const auto degrees = [](const glm::dvec3& u, const glm::dvec3& v) { return Degrees(AngleBetween(u, v)); };

  PoseFeatures features;
  features[kRH] = degrees(limb(kRightShoulder, kRightElbow), down);
  features[kLH] = degrees(limb(kLeftShoulder, kLeftElbow), down);
  features[kRHE] = degrees(limb(kRightShoulder, kRightElbow), limb(kRightElbow, kRightWrist));
  features[kLHE] = degrees(limb(kLeftShoulder, kLeftElbow), limb(kLeftElbow, kLeftWrist));
  constexpr double kStandingScale = 80;  // value of Posture when standing, as in equations 7–10
  features[kPosture] = kStandingScale * pose[kHipCentre].y / standing_hip_height;
  features[kTrunk] = 180.0 - degrees(trunk, {0, 1, 0});
  features[kRF] = degrees(limb(kRightHip, kRightKnee), down);
  features[kLF] = degrees(limb(kLeftHip, kLeftKnee), down);
  features[kRFK] = KneeDegrees(pose[kRightHip], pose[kRightKnee], pose[kRightAnkle]);
  features[kLFK] = KneeDegrees(pose[kLeftHip], pose[kLeftKnee], pose[kLeftAnkle]);
  return features;
}

double StandingHipHeight(const BodyPose& pose) {
  const auto length = [&](Role from, Role to) { return glm::distance(pose[from], pose[to]); };
  const double thigh = 0.5 * (length(kLeftHip, kLeftKnee) + length(kRightHip, kRightKnee));
  const double shank = 0.5 * (length(kLeftKnee, kLeftAnkle) + length(kRightKnee, kRightAnkle));
  // The ankle's height above the sole is 0.039 of the stature, and the shank's length is 0.246 of it (Drillis and
  // Contini 1966). The foot bone cannot be used, because in some files it ends at the base of the toe, and in others at
  // the tip of the toe.
  constexpr double kAnkleHeightPerShank = 0.039 / 0.246;
  return thigh + shank * (1.0 + kAnkleHeightPerShank);
}

}  // namespace etude
