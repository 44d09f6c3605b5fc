#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/fuzzy/features.h"
#include "engine/transitions/library/body_proportions.h"
#include "io/clips/clip_library.h"
#include "sim/choreography/controls.h"
#include "sim/random/stream.h"

namespace etude {

/// Two poses that look clearly different but have a small fuzzy distance. Paper A's features measure how far a limb is
/// raised but not in which direction, and their membership functions are flat in ranges that were thought unimportant.
struct BlindSpot {
  std::string_view name;  ///< what differs between the poses, e.g. "arm forward or sideways"
  Controls a, b;          ///< controls of the two poses, for the body of the built-in moves
};

/// Returns the eight blind spots.
std::span<const BlindSpot> BlindSpots();

/// A pose and its fuzzy features.
struct SeenPose {
  BodyPose pose;
  PoseFeatures features;
};

struct SeenPair {
  SeenPose a, b;
  double gap_m = 0;  ///< the truth: PoseGap, the largest distance between the same joints after alignment on the floor
};

/// Pairs of poses that a method must classify as alike or not.
struct PairWorld {
  std::string name;             ///< name of the blind spot; empty for frames
  std::string clip_a, clip_b;   ///< sources of the clips of the poses; empty for a blind spot
  std::vector<SeenPair> pairs;  ///< at least one pair
};

/// The kind of pairs in a world.
enum class PairSource {
  kBlindSpots,  ///< trial i shows the (i mod 8)th of BlindSpots
  kFrames,      ///< random frames of two different clips
};

/// Clips performed by one body, from which frames are drawn.
struct DancedClips {
  BodyProportions proportions;
  std::vector<std::string> names;
  std::vector<std::string> identities;  ///< the source of each clip; equal for equal clips
  std::vector<BodyMotion> motions;
};

/// Retargets the clips to the body of the built-in moves.
DancedClips DanceClips(const ClipLibrary& library);

/// Returns true if the clips have at least two different sources (`identities`).
bool HasTwoSources(const DancedClips& clips);

PairWorld ShowBlindSpot(int trial);

/// Draws two clips from different sources and returns their indices. The trial number determines the first clip. The
/// clips must have at least two sources (HasTwoSources).
std::pair<std::size_t, std::size_t> DrawClips(const DancedClips& clips, const WorldKey& key);

/// Draws two clips, and `count` pairs of frames. Each pair has a random frame of one clip and a random frame of the
/// other, both with uniform distribution.
PairWorld DrawFramePairs(const DancedClips& clips, int count, const WorldKey& key);

}  // namespace etude
