#pragma once

#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/fuzzy/distance.h"
#include "engine/fuzzy/membership.h"
#include "engine/motion/body.h"

namespace etude {

/// Paper A's rule that a frame with a large head motion is never a bridge frame. The limits are ours.
struct HeadRule {
  double max_bend = Radians(30);        ///< largest angle between the neck and the line of the trunk
  double max_turn_speed = Radians(60);  ///< largest angular velocity of the neck relative to the trunk, per second
};

/// For each frame, returns true if the head is still enough.
std::vector<bool> FindQuietHeads(const BodyMotion& motion, const HeadRule& rule = {});

/// A clip prepared for the search: grades and tags of every frame, and the bridge frames.
struct TaggedClip {
  double rate_hz = kJudgedRateHz;
  std::vector<Grades> grades;      ///< one per frame
  std::vector<Tags> tags;          ///< one per frame
  std::vector<int> bridge_frames;  ///< in ascending order

  int FrameCount() const { return static_cast<int>(grades.size()); }
  bool InFrontHalf(int frame) const { return frame < FrameCount() / 2; }
};

/// The rules that tag frames and select bridge frames.
struct TagRules {
  Memberships memberships = PaperMemberships();
  HeadRule head;
  int min_clips = 2;  ///< minimum number of clips that contain the ten tags of a bridge frame *(ours)*
  /// The maximum number of bridge frames with the same ten tags in one clip. The frames with the smallest differences
  /// from the other clips are kept (RateFrames). 0 keeps all frames: paper A asks for "those of smallest difference",
  /// but also for as many as possible.
  int most_per_class = 0;
  FeatureWeights weights = PaperWeights();  ///< weights of the distance by which frames differ
};

/// Selects the bridge frames of a library: frames whose ten tags occur together in at least `min_clips` clips and whose
/// head is quiet, at most `most_per_class` per class (0: all). All clips are performed by one body, whose
/// `standing_hip_height` is in metres.
std::vector<TaggedClip> TagClips(std::span<const BodyMotion> clips, double standing_hip_height,
                                 const TagRules& rules = {});

/// The frequency of a frame's pose in a library, and the distance of the frame from other frames with this pose (paper
/// A, section 3.4: bridge frames are frequent poses, "those of smallest difference").
struct FrameRating {
  int clips = 0;   ///< number of clips, including its own, in which the frame's ten tags occur together
  int frames = 0;  ///< number of frames of the library with these tags
  /// The root mean square of this frame's distances (paper A, equation 1) from the frames with the same tags in other
  /// clips. It estimates the distance of a transition between frames with these tags. 0 if no other clip has these
  /// tags.
  double difference = 0;
};

/// Rates every frame of every clip from its tags and grades. The result is indexed `[clip][frame]`.
std::vector<std::vector<FrameRating>> RateFrames(std::span<const TaggedClip> clips, const FeatureWeights& weights);

}  // namespace etude
