#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bench/metrics/evaluation.h"
#include "bench/metrics/pose_error.h"

namespace etude {

/// How the answer is aligned with the truth before the comparison: by a rigid transformation or, with `_scaled`, by a
/// similarity, fitted to the joints that both show. It is never a reflection.
enum class Alignment {
  kNone,
  kRoot,         ///< in each frame, by the translation of root onto root
  kRootScaled,   ///< as kRoot, with the scale of least squared error in each frame (N-MPJPE)
  kFirst,        ///< by the best fit of the first frame with three joints seen by both, in all frames
  kFirstScaled,  ///< as kFirst, by a similarity
  kTake,         ///< by the best fit of all frames together
  kTakeScaled,   ///< as kTake, by a similarity
  kFrame,        ///< in each frame, by its own best fit
  kFrameScaled,  ///< as kFrame, by a similarity (PA-MPJPE)
};

/// The transformation that aligns each frame of an answer; nothing where it is not determined: without a root, or with
/// fewer than three joints seen by both.
struct FrameFits {
  std::vector<std::optional<Similarity>> fits;
  std::size_t length = 1;  ///< number of successive frames that share one fit

  const std::optional<Similarity>& At(std::size_t frame) const { return fits[frame / length]; }
};

/// Finds the alignments of an answer. The sums and fits of single frames, which most alignments use, are computed once.
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

/// Returns the best similarity, or without scale the best rigid transformation; nothing for fewer than three points.
std::optional<Similarity> Fit(const PointMoments& moments, bool with_scale);

/// Returns the distance of each joint, after the alignment, from its truth, frames × joints, millimetres; NaN where
/// either is not seen or not aligned.
std::vector<double> JointErrorsMm(const EvaluatedPair& pair, const FrameFits& fits);
/// Returns the mean of these distances, ignoring NaN; nothing if all are NaN.
std::optional<double> MeanJointErrorMm(const EvaluatedPair& pair, const FrameFits& fits);

}  // namespace etude
