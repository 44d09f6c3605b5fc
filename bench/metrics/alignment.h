#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bench/metrics/evaluation.h"
#include "bench/metrics/pose_error.h"

namespace etude {

/// What is taken out of the answer before it is compared: a movement or, with `_scaled`, a similarity, found from the
/// joints that both show. Reflections are never taken out.
enum class Alignment {
  kNone,
  kRoot,         ///< in each frame, root onto root
  kRootScaled,   ///< … and the one scale of that frame with the least squared error (N-MPJPE)
  kFirst,        ///< the movement that fits the first frame best
  kFirstScaled,  ///< …
  kTake,         ///< the movement that fits all frames best
  kTakeScaled,   ///< …
  kFrame,        ///< in each frame, the movement that fits it best
  kFrameScaled,  ///< … (PA-MPJPE)
};

/// What aligns each frame of an answer; nothing in frames in which the alignment is not determined: without root, or
/// with fewer than three joints seen by both.
struct FrameFits {
  std::vector<std::optional<Similarity>> fits;
  std::size_t length = 1;  ///< frames in a row that share one of them

  const std::optional<Similarity>& At(std::size_t frame) const { return fits[frame / length]; }
};

/// Finds the alignments of an answer. What they share is computed once.
class PairFits {
 public:
  /// `pair` must outlive the object.
  explicit PairFits(const EvaluatedPair& pair);

  FrameFits Of(Alignment alignment) const;
  /// Fits segments of `length` frames, each by its first `fitted` frames alone, as similarities (W-MPJPE, WA-MPJPE).
  /// The last segment may be shorter.
  FrameFits OfSegments(std::size_t length, std::size_t fitted) const;

 private:
  FrameFits ByRoot(bool with_scale) const;

  const EvaluatedPair& pair_;
  std::vector<PointMoments> moments_;  // by frame
  std::vector<std::optional<Similarity>> each_frame_;
};

/// Returns the best similarity, or the best movement; nothing for fewer than three points.
std::optional<Similarity> Fit(const PointMoments& moments, bool with_scale);

/// Returns the distance of each joint, after the alignment, from its truth, frames × joints, millimetres; NaN where
/// either is not seen or not aligned.
std::vector<double> JointErrorsMm(const EvaluatedPair& pair, const FrameFits& fits);
/// Returns the mean of these distances, ignoring NaN; nothing if all are NaN.
std::optional<double> MeanJointErrorMm(const EvaluatedPair& pair, const FrameFits& fits);

}  // namespace etude
