#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "engine/motion/body.h"

namespace etude {

/// Paper A's ten pose features (table 1), in the paper's order.
enum class Feature { kRH, kLH, kRHE, kLHE, kPosture, kTrunk, kRF, kLF, kRFK, kLFK };
constexpr std::size_t kFeatureCount = 10;

std::span<const Feature, kFeatureCount> AllFeatures();
/// Returns "RH", "LH", "RHE", "LHE", "Posture", "Trunk", "RF", "LF", "RFK", "LFK".
std::string_view FeatureName(Feature feature);
/// Returns the feature of that name, null when there is none.
const Feature* FindFeature(std::string_view name);
/// Lists the joints whose positions enter the feature.
std::span<const Role> JointsOf(Feature feature);

/// The crisp inputs of the membership functions: degrees, but for Posture (standing = 80).
struct PoseFeatures {
  std::array<double, kFeatureCount> values{};
  double operator[](Feature feature) const { return values[static_cast<std::size_t>(feature)]; }
  double& operator[](Feature feature) { return values[static_cast<std::size_t>(feature)]; }
};

/// The ten features of one frame (algorithms A1). `standing_hip_height` is the height of this body's
/// hip centre above the floor when it stands, metres, > 0. A limb of zero length gives angle 0.
PoseFeatures ComputeFeatures(const BodyPose& pose, double standing_hip_height);

/// The hip height of a standing body, read off its limb lengths: both legs straight, feet flat.
double StandingHipHeight(const BodyPose& pose);

}  // namespace etude
