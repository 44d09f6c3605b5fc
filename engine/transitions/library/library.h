#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/body.h"
#include "engine/transitions/library/body_proportions.h"
#include "engine/transitions/library/bridge_frames.h"
#include "engine/transitions/library/in_betweens.h"

namespace etude {

/// The numbers of nine vectors: where feet and hands are, how fast they move, and how fast the hips move.
constexpr std::size_t kMotionFeatureCount = 27;
/// The features that motion matching compares (Clavet 2016; Holden et al. 2020): hands and feet as seen from the
/// character, who is at the origin of the floor and faces +Z, and the velocities of hands, feet and hips in the same
/// axes.
using MotionFeatures = std::array<double, kMotionFeatureCount>;
double SquaredDistance(const MotionFeatures& a, const MotionFeatures& b);

/// The features of every frame of every clip. Each of the nine vectors is divided by its own standard deviation over
/// all frames of the library, so that metres and metres per second count alike; one that never varies counts nothing.
std::vector<std::vector<MotionFeatures>> ComputeMotionFeatures(std::span<const BodyMotion> clips);

/// Returns the largest second difference of any joint that nine of ten frames of a motion keep to, metres per frame²; 0
/// of fewer than three frames.
double UsualAcceleration(const BodyMotion& motion);

/// The stance of a body, as far as a join must know it.
struct Stance {
  /// It lies, sits or kneels: its mass centre is more than a quarter of a metre beside its feet, seen from above, and
  /// its hips are no more than 0.6 of a standing body's height above its lowest joint.
  bool is_down = false;
  double hips = 0;  ///< the height of the hips above the lowest joint, metres
};
Stance StanceOf(const BodyPose& pose, double standing_hip_height);

/// Tells whether a join would have to raise or lower a body on nothing: in one stance at least it is down, and its hips
/// differ by more than 0.2 m. Only a clip can show how that is done.
bool NeedsClip(const Stance& a, const Stance& b);

/// Clips made ready for transitions: all performed by one body, at 30 Hz, tagged, and joined by in-betweens.
struct MotionLibrary {
  BodyProportions proportions;
  std::vector<std::string> names;
  std::vector<BodyMotion> motions;
  std::vector<TaggedClip> tagged;                     ///< as `motions`, frame by frame
  std::vector<std::vector<MotionFeatures>> features;  ///< as `motions`, frame by frame
  std::vector<double> usual_accelerations;            ///< as `motions`: UsualAcceleration
  std::vector<std::vector<Stance>> stances;           ///< as `motions`, frame by frame
  InBetweenNet in_betweens;
};

/// Makes a library of motions that one body performs already, at 30 Hz: tags them by `rules`, and builds in-betweens
/// that move by `tween`.
MotionLibrary MakeLibraryOfOneBody(std::vector<std::string> names, std::vector<BodyMotion> motions,
                                   const BodyProportions& proportions, const TagRules& rules = {},
                                   const TweenRules& tween = {});

/// Makes a library of clips as they came: has them performed by one body, and goes on as MakeLibraryOfOneBody.
MotionLibrary MakeLibrary(std::vector<std::string> names, std::span<const BodyMotion> clips,
                          const BodyProportions& proportions, const TagRules& rules = {}, const TweenRules& tween = {});

}  // namespace etude
