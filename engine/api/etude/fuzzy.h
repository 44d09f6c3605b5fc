#pragma once

#include <etude/motion.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/fuzzy/features.h"

namespace etude::engine {

/// Returns the ten pose features of every frame. The standing height of the hips is computed from the limb lengths of
/// the first frame. Throws BadInput for a body without legs.
ETUDE_API std::vector<PoseFeatures> ComputeFeatures(const BodyMotion& motion);

/// Returns the fuzzy distance of two frames, 0 or more: the weighted Euclidean distance between the frames' vectors of
/// 24 membership grades. Throws BadInput for features that are not finite.
ETUDE_API double FuzzyDistance(const PoseFeatures& a, const PoseFeatures& b);

/// A pair of matching frames: a transition leaves the playing clip at `from` and enters the wanted clip at `to`.
struct TransitionPoint {
  int from = 0;
  int to = 0;
  double distance = 0;
};

struct BridgeOptions {
  /// A frame can be a bridge frame only if its ten fuzzy terms occur together in at least this many clips.
  int min_clips = 2;
  /// Frames match below this fuzzy distance; a larger threshold finds more transitions, but worse ones.
  double threshold = 0.4;
};

/// Clips prepared for transitions: transferred to the body of the first clip, and tagged.
class ETUDE_API Bridges {
 public:
  /// Throws BadInput for no clips, a clip without frames or with a rate other than the first clip's, or options
  /// out of range.
  explicit Bridges(std::span<const BodyMotion> clips, const BridgeOptions& options = {});
  Bridges(Bridges&&) noexcept;
  Bridges& operator=(Bridges&&) noexcept;
  ~Bridges();

  /// Returns the bridge frames of a clip in ascending order: frames in poses that several clips share, with the head
  /// held still.
  std::span<const int> FramesOf(int clip) const;

  /// Finds the first pair of bridge frames that match while clip `from` continues from `frame` for at most `budget_s`
  /// seconds. Throws BadInput for a clip or frame that does not exist.
  std::optional<TransitionPoint> Find(int from, int frame, int to, double budget_s = 1) const;

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace etude::engine
