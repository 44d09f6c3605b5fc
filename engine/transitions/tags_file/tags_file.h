#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/embedded_text.h"
#include "engine/base/result.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/library/transition_points.h"

namespace etude {

/// Returns docs/schemas/bridge-tags.xsd, the only schema (written by the build).
std::span<const EmbeddedText> TagsFileSchemas();

/// A bridge frame with its tags (paper A, section 3.4).
struct TaggedFrame {
  int frame = 0;  ///< of its clip, counted from 0
  Tags tags{};
  Grades grades{};
  int clips = 1;          ///< in how many clips of the library its ten tags occur together
  double difference = 0;  ///< to the frames of the same tags in other clips (FrameRating)

  friend bool operator==(const TaggedFrame&, const TaggedFrame&) = default;
};

/// A clip's part of a tags file.
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

/// The contents of a tags file: the bridge frames of a library, and what they were found by.
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

/// Collects the tags of a library that was made by `tag_rules` and `system`. `sources` as the library's clips.
BridgeTags CollectTags(const MotionLibrary& library, std::span<const std::string> sources, const FuzzySystem& system,
                       const TagRules& tag_rules, const MatchRules& match_rules);

/// The largest tags file, bytes: larger ones are refused before memory is taken.
constexpr std::size_t kLargestTagsFile = 512'000'000;

/// Writes the tags as XML of docs/schemas/bridge-tags.xsd: the same bytes for the same tags, numbers with the fewest
/// digits that read back the same. Refused: names that XML cannot hold (bytes that are no UTF-8, control characters).
Result<std::string> WriteTagsFile(const BridgeTags& tags);

/// Reads what WriteTagsFile writes, to the last bit; `file` is what complaints call it. Everything is held against the
/// schema, and against itself: frames lie within their clips and rise, times and tags follow from frames and grades,
/// clips have names of their own, keys are bridge frames. A document type declaration is refused: nothing is loaded
/// or expanded.
Result<BridgeTags> ReadTagsFile(std::string_view text, const std::string& file);

/// The differences and matches of two sets of tags.
struct TagsComparison {
  std::vector<std::string> differences;  ///< one line each
  int clips = 0;                         ///< in both
  int bridge_frames = 0;                 ///< in both
};

/// Compares the tags of a file with those that its clips have now: rules, clips, frames and keys must be the same,
/// grades and differences to 10⁻⁹.
TagsComparison CompareTags(const BridgeTags& file, const BridgeTags& now);

}  // namespace etude
