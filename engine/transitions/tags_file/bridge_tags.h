#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/fuzzy/fuzzy_system.h"
#include "engine/transitions/bridge_frames/transition_points.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// A bridge frame with its tags (paper A, section 3.4).
struct TaggedFrame {
  int frame = 0;  ///< of its clip, counted from 0
  Tags tags{};
  Grades grades{};
  int clips = 1;          ///< in how many clips of the library its ten tags occur together
  double difference = 0;  ///< to the frames of the same tags in other clips (FrameRating)

  friend bool operator==(const TaggedFrame&, const TaggedFrame&) = default;
};

/// What a tags file holds of a clip.
struct ClipTags {
  std::string name, source;  ///< what tables call it, and what opens it
  int frames = 0;
  double rate_hz = kJudgedRateHz;
  std::vector<TaggedFrame> bridge_frames;  ///< rising

  friend bool operator==(const ClipTags&, const ClipTags&) = default;
};

/// A bridge frame that in-betweens are built of, by the name of its clip.
struct KeyTag {
  std::string clip;
  int frame = 0;

  friend bool operator==(const KeyTag&, const KeyTag&) = default;
};

/// All that a tags file holds: the bridge frames of a library, and what they were found by.
struct BridgeTags {
  std::string system;              ///< the fuzzy system's name
  std::string memberships_digest;  ///< sixteen hexadecimal digits: of its membership functions
  FeatureWeights weights{};        ///< S of equation 1
  double threshold = kPaperThreshold;
  bool within_class = false;
  int min_clips = 2, most_per_class = 0;                      ///< TagRules
  double max_neck_bend_deg = 0, max_neck_turn_deg_per_s = 0;  ///< HeadRule
  double standing_hip_height_m = 0;                           ///< of the body that performs all clips
  std::vector<ClipTags> clips;                                ///< by names that are unique
  std::vector<KeyTag> keys;                                   ///< the first is the hub

  friend bool operator==(const BridgeTags&, const BridgeTags&) = default;
};

/// Tells one set of membership functions from another.
std::string MembershipsDigest(const FuzzySystem& system);

/// The tags of a library that was made by `tag_rules` and `system`. `sources` as the library's clips.
BridgeTags CollectTags(const MotionLibrary& library, std::span<const std::string> sources, const FuzzySystem& system,
                       const TagRules& tag_rules, const MatchRules& match_rules);

}  // namespace etude
