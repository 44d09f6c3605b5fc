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

/// The number of coordinates of nine vectors: positions and velocities of both feet and both hands, and the velocity of
/// the hips.
constexpr std::size_t kMotionFeatureCount = 27;
/// The features that motion matching compares (Clavet 2016; Holden et al. 2020). They are the positions of hands and
/// feet relative to the character, who is at the origin of the floor and faces +Z, and the velocities of hands, feet
/// and hips in the same axes.
using MotionFeatures = std::array<double, kMotionFeatureCount>;
double SquaredDistance(const MotionFeatures& a, const MotionFeatures& b);

/// Computes the features of every frame of every clip. Each of the nine vectors is divided by its standard deviation
/// over all frames of the library, which gives metres and metres per second equal weight. A vector that never varies is
/// set to 0.
std::vector<std::vector<MotionFeatures>> ComputeMotionFeatures(std::span<const BodyMotion> clips);

/// Returns the 90th percentile, over the frames of a motion, of the largest second difference of any joint, in metres
/// per frame²; 0 for fewer than three frames.
double UsualAcceleration(const BodyMotion& motion);

/// The properties of a body's stance that decide whether two frames can be joined.
struct Stance {
  /// True if the body lies, sits or kneels: the centre of mass is horizontally more than 0.25 m away from the feet, and
  /// the hips are at most 0.6 times the standing hip height above the lowest joint.
  bool is_down = false;
  double hips = 0;  ///< height of the hips above the lowest joint, metres
};
Stance StanceOf(const BodyPose& pose, double standing_hip_height);

/// Returns true if at least one of the two stances is down and their hip heights differ by more than 0.2 m. A join
/// would then raise or lower a body that nothing supports; only a recorded clip can show such a motion.
bool NeedsClip(const Stance& a, const Stance& b);

/// Returns, for every frame of a clip, the distance of the zero-moment point from the joints that support the body
/// (FindBearing), metres; 0 in a frame without such joints.
std::vector<double> ZeroMomentOffsets(const BodyMotion& motion);

/// Clips of one body at 30 Hz, with their tags and in-betweens.
struct TaggedLibrary {
  BodyProportions proportions;
  std::vector<std::string> names;
  std::vector<TaggedClip> tagged;  ///< one per clip
  InBetweenNet in_betweens;
};

/// A tagged library with its motions and the data that choices and joins need.
struct MotionLibrary : TaggedLibrary {
  std::vector<BodyMotion> motions;                    ///< one per clip, as in `tagged` and the other members
  std::vector<std::vector<MotionFeatures>> features;
  std::vector<double> usual_accelerations;            ///< UsualAcceleration of each clip
  std::vector<std::vector<Stance>> stances;
  std::vector<std::vector<double>> beside_feet;       ///< ZeroMomentOffsets of each clip
};

/// Makes a library from motions of one body at 30 Hz. `rules` select tags and bridge frames; `tween` sets the speed of
/// the in-betweens.
MotionLibrary MakeLibraryOfOneBody(std::vector<std::string> names, std::vector<BodyMotion> motions,
                                   const BodyProportions& proportions, const TagRules& rules = {},
                                   const TweenRules& tween = {});

/// Makes a library from clips of any bodies: transfers them to one body (PerformedBy), then calls MakeLibraryOfOneBody.
MotionLibrary MakeLibrary(std::vector<std::string> names, std::span<const BodyMotion> clips,
                          const BodyProportions& proportions, const TagRules& rules = {}, const TweenRules& tween = {});

}  // namespace etude
