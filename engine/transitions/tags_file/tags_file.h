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

/// Returns one schema, docs/schemas/bridge-tags.xsd, which the build embeds in the program.
std::span<const EmbeddedText> TagsFileSchemas();

/// A bridge frame with its tags (paper A, section 3.4).
struct TaggedFrame {
  int frame = 0;  ///< index in its clip, from 0
  Tags tags{};
  Grades grades{};
  int clips = 1;          ///< number of the library's clips in which the frame's ten tags occur together
  double difference = 0;  ///< FrameRating::difference: the distance from frames with the same tags in other clips

  friend bool operator==(const TaggedFrame&, const TaggedFrame&) = default;
};

/// The entry of one clip in a tags file.
struct ClipTags {
  std::string name, source;  ///< the clip's name in tables, and the name from which it is loaded
  int frames = 0;
  double rate_hz = kJudgedRateHz;
  std::vector<TaggedFrame> bridge_frames;  ///< in ascending order

  friend bool operator==(const ClipTags&, const ClipTags&) = default;
};

/// A bridge frame from which in-betweens are built, with the name of its clip.
struct KeyTag {
  std::string clip;
  int frame = 0;

  friend bool operator==(const KeyTag&, const KeyTag&) = default;
};

/// The contents of a tags file: the bridge frames of a library, and the rules that found them.
struct BridgeTags {
  std::string system;              ///< the fuzzy system's name
  std::string memberships_digest;  ///< digest of the membership functions: sixteen hexadecimal digits
  FeatureWeights weights{};        ///< the weights S of paper A's equation 1
  double threshold = kPaperThreshold;
  bool within_class = false;
  int min_clips = 2, most_per_class = 0;                      ///< as in TagRules
  double max_neck_bend_deg = 0, max_neck_turn_deg_per_s = 0;  ///< as in HeadRule
  double standing_hip_height_m = 0;                           ///< of the body that performs all clips, metres
  std::vector<ClipTags> clips;                                ///< with unique names
  std::vector<KeyTag> keys;                                   ///< the first is the hub

  friend bool operator==(const BridgeTags&, const BridgeTags&) = default;
};

/// Returns a digest that identifies a set of membership functions.
std::string MembershipsDigest(const FuzzySystem& system);

/// Collects the tags of a library that was made with `tag_rules` and `system`. `sources` has one entry per clip.
BridgeTags CollectTags(const TaggedLibrary& library, std::span<const std::string> sources, const FuzzySystem& system,
                       const TagRules& tag_rules, const MatchRules& match_rules);

/// The maximum size of a tags file in bytes. Larger files are rejected before memory is allocated.
constexpr std::size_t kMaxTagsFileBytes = 512'000'000;

/// Writes the tags as XML by docs/schemas/bridge-tags.xsd. The same tags give the same bytes. Numbers have the fewest
/// digits that are read back exactly. Returns an error for names that XML cannot hold (invalid UTF-8, control
/// characters).
Result<std::string> WriteTagsFile(const BridgeTags& tags);

/// Reads a text in the format of WriteTagsFile; numbers are read back bit for bit. Error messages name the text `file`.
/// The text is validated against the schema and checked for consistency: frame numbers ascend and lie within their
/// clips, times follow from frames, tags follow from grades, clip names are unique, keys are bridge frames. A document
/// type declaration is an error, and no entity is loaded or expanded.
Result<BridgeTags> ReadTagsFile(std::string_view text, const std::string& file);

/// The result of comparing two sets of tags.
struct TagsComparison {
  std::vector<std::string> differences;  ///< one line each
  int clips = 0;                         ///< number of clips in both sets of tags
  int bridge_frames = 0;                 ///< number of bridge frames in both sets of tags
};

/// Compares the tags of a file with the current tags of its clips. Rules, clips, frames and keys must be equal; grades
/// and differences must agree to 10⁻⁹.
TagsComparison CompareTags(const BridgeTags& file, const BridgeTags& now);

}  // namespace etude
