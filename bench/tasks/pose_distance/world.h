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

/// Two poses that anyone tells apart, and paper A's distance hardly does: its features know how far a limb is raised,
/// not in which direction, and their membership functions are flat where nothing was thought to happen.
struct BlindSpot {
  std::string_view name;  ///< "arm forward or sideways"
  Controls a, b;          ///< performed by the body of the built-in moves
};

/// Eight of them.
std::span<const BlindSpot> BlindSpots();

/// A pose and what the fuzzy side sees of it.
struct SeenPose {
  BodyPose pose;
  PoseFeatures features;
};

struct SeenPair {
  SeenPose a, b;
  double gap_m = 0;  ///< the truth: PoseGap, the distance of the worst joint after alignment on the floor
};

/// Pairs of poses to be told alike or not.
struct PairWorld {
  std::string name;             ///< of the blind spot; empty for frames
  std::string clip_a, clip_b;   ///< identities of the clips that the poses were taken from; empty for a blind spot
  std::vector<SeenPair> pairs;  ///< one or more
};

/// The pairs that a world is made of.
enum class PairSource {
  kBlindSpots,  ///< trial i shows the (i mod 8)th of BlindSpots
  kFrames,      ///< any frames of two different clips
};

/// Clips of one body, to draw frames of.
struct DancedClips {
  BodyProportions proportions;
  std::vector<std::string> names;
  std::vector<std::string> identities;  ///< equal for equal dances: what opens the clip
  std::vector<BodyMotion> motions;
};

/// The clips are retargeted to the body of the built-in moves.
DancedClips DanceClips(const ClipLibrary& library);

/// True when there are clips of two different identities.
bool HoldsTwoDances(const DancedClips& clips);

PairWorld ShowBlindSpot(int trial);

/// Two clips of different identities, by index; the first goes round-robin with the trials. The clips must hold two
/// dances.
std::pair<std::size_t, std::size_t> DrawClips(const DancedClips& clips, const WorldKey& key);

/// Draws two clips, and `count` pairs of a frame of the one and a frame of the other, each pair drawn evenly.
PairWorld DrawFramePairs(const DancedClips& clips, int count, const WorldKey& key);

}  // namespace etude
