#pragma once

#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/fuzzy/distance.h"
#include "engine/fuzzy/membership.h"
#include "engine/motion/body.h"

namespace etude {

/// Paper A: a frame with a large head motion is never a bridge frame. The limits are ours.
struct HeadRule {
  double max_bend = Radians(30);        ///< radians, the neck off the trunk's line
  double max_turn_speed = Radians(60);  ///< radians per second, of the neck as seen from the trunk
};

/// Says of each frame whether it keeps the head still enough.
std::vector<bool> FindQuietHeads(const BodyMotion& motion, const HeadRule& rule = {});

/// A clip as the search sees it: the fuzzy side of every frame, and its bridge frames.
struct TaggedClip {
  double rate_hz = kJudgedRateHz;
  std::vector<Grades> grades;      ///< one per frame
  std::vector<Tags> tags;          ///< one per frame
  std::vector<int> bridge_frames;  ///< rising

  int FrameCount() const { return static_cast<int>(grades.size()); }
  bool InFrontHalf(int frame) const { return frame < FrameCount() / 2; }
};

/// The rules by which frames are tagged and become bridge frames.
struct TagRules {
  Memberships memberships = PaperMemberships();
  HeadRule head;
  int min_clips = 2;  ///< in how many clips a bridge frame's ten tags occur together at least; ours
  /// The most bridge frames of a clip with the same ten tags: those of smallest difference to the other clips
  /// (RateFrames). 0 = all: paper A wants "those of smallest difference", and as many as can be, for freedom.
  int most_per_class = 0;
  FeatureWeights weights = PaperWeights();  ///< of that difference
};

/// Marks the bridge frames of a library (algorithms A4): frames whose ten tags occur together in enough of its clips,
/// and whose head is quiet; of those `most_per_class`. `standing_hip_height` is the one of the body that performs all
/// clips, metres.
std::vector<TaggedClip> TagClips(std::span<const BodyMotion> clips, double standing_hip_height,
                                 const TagRules& rules = {});

struct TaggedClip;

/// The frequency of a frame's pose in a library, and how well the frame stands for it (paper A, section 3.4: bridge
/// frames are frequent poses, "those of smallest difference").
struct FrameRating {
  int clips = 0;   ///< in how many clips the frame's ten tags occur together, its own included
  int frames = 0;  ///< in how many frames of the library
  /// The root mean square of the distances to the frames of the same tags in other clips (equation 1): what a
  /// transition within the class would cost. 0 when no other clip has them.
  double difference = 0;
};

/// Rates every frame of every clip, `[clip][frame]`; uses tags and grades only.
std::vector<std::vector<FrameRating>> RateFrames(std::span<const TaggedClip> clips, const FeatureWeights& weights);

}  // namespace etude
