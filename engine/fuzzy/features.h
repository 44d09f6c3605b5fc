#pragma once

#include <array>
#include <span>
#include <string_view>

#include "engine/motion/body.h"

namespace [[gnu::visibility("default")]] etude {

/// Paper A's ten pose features (table 1), in the paper's order.
enum class Feature { kRH, kLH, kRHE, kLHE, kPosture, kTrunk, kRF, kLF, kRFK, kLFK };
constexpr std::size_t kFeatureCount = 10;

std::span<const Feature, kFeatureCount> AllFeatures();
/// Returns the feature's name in paper A's table 1: "RH", "LH", "RHE", "LHE", "Posture", "Trunk", "RF", "LF", "RFK" or
/// "LFK".
std::string_view FeatureName(Feature feature);
/// Returns the feature called `name`, or null if there is none.
const Feature* FindFeature(std::string_view name);
/// Returns the joints whose positions the feature depends on.
std::span<const Role> JointsOf(Feature feature);

/// The crisp inputs of the membership functions. They are angles in degrees; only Posture is a height, scaled so that
/// standing gives 80.
struct PoseFeatures {
  std::array<double, kFeatureCount> values{};
  double operator[](Feature feature) const { return values[static_cast<std::size_t>(feature)]; }
  double& operator[](Feature feature) { return values[static_cast<std::size_t>(feature)]; }
};

/// Computes the ten features of one frame. `standing_hip_height` is the height of this body's hip
/// centre above the floor when standing, in metres, > 0. A limb of zero length gives the angle 0.
PoseFeatures ComputeFeatures(const BodyPose& pose, double standing_hip_height);

/// Returns the hip height of the body when standing with straight legs and flat feet, metres, computed from the limb
/// lengths of `pose`.
double StandingHipHeight(const BodyPose& pose);

}  // namespace etude
