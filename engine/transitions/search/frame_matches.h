#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/fuzzy/distance.h"
#include "engine/transitions/search/grade_index.h"

namespace etude {

/// A clip as partners are looked for in it and for it. The caller keeps what the spans show.
struct PartnerClip {
  std::span<const Grades> grades;                             ///< one per frame
  std::optional<std::span<const int>> frames = std::nullopt;  ///< those that take part (bridge frames), rising; or all
  std::span<const Tags> tags = {};                            ///< one per frame; only read `within_class`
};

struct PartnerRules {
  FeatureWeights weights = PaperWeights();
  double threshold = kPaperThreshold;
  bool within_class = false;  ///< ours: only frames with the same ten tags are partners
};

/// A frame's partners in another clip: frames that one may switch to from it, d < threshold.
struct FramePartners {
  int frame = 0;        ///< of the clip that is left
  int first = 0;        ///< its first partner in time order: paper A's "front half, then rear half"
  int nearest = 0;      ///< its nearest one; the first of several
  double distance = 0;  ///< of the nearest
};

/// Every frame's first and nearest partner in every other clip.
class PartnerTable {
 public:
  int ClipCount() const { return static_cast<int>(asked_.size()); }
  /// How many frames of a clip looked for partners.
  int AskedFrames(int clip) const { return asked_[static_cast<std::size_t>(clip)]; }
  /// The frames of clip `from` with a partner in clip `to`, rising; none when both are the same clip.
  std::span<const FramePartners> Of(int from, int to) const { return found_[Pair(from, to)]; }
  /// The reachability matrix: the share of `from`'s asked frames with a partner in `to`, in [0, 1]; 0 when none asked.
  double Share(int from, int to) const;

 private:
  friend PartnerTable FindPartners(std::span<const PartnerClip> clips, const PartnerRules& rules, SearchWork* work);
  std::size_t Pair(int from, int to) const { return static_cast<std::size_t>(from) * asked_.size() + to; }

  std::vector<int> asked_;
  std::vector<std::vector<FramePartners>> found_;  // by Pair
};

/// Looks for the partners of every clip's frames in every other clip. The last frame of a clip is never a partner:
/// nothing would follow it. Exact, as GradeIndex is.
PartnerTable FindPartners(std::span<const PartnerClip> clips, const PartnerRules& rules = {},
                          SearchWork* work = nullptr);

}  // namespace etude
