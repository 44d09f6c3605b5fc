#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "bench/metrics/evaluation.h"
#include "bench/metrics/pose_error.h"

namespace etude {

/// The way in which the answer is aligned with the truth before the comparison. The transformation is rigid, or a
/// similarity for names that end in `Scaled`. From kFirst on, it is fitted to the joints seen in answer and truth, and
/// is never a reflection.
enum class Alignment {
  kNone,
  kRoot,         ///< each frame is moved so that the roots coincide
  kRootScaled,   ///< as kRoot; each frame is also scaled for the least squared error (N-MPJPE)
  kFirst,        ///< all frames share the fit of the first frame in which answer and truth show three joints
  kFirstScaled,  ///< as kFirst, but the fit is a similarity
  kTake,         ///< all frames have the best fit of the whole take
  kTakeScaled,   ///< as kTake, but the fit is a similarity
  kFrame,        ///< each frame has its own best fit
  kFrameScaled,  ///< as kFrame, but the fit is a similarity (PA-MPJPE)
};

/// The smallest number of points to which a transformation is fitted; fewer do not determine a rotation.
inline constexpr double kMinFitted = 3;

/// The transformations that align the frames of an answer. A frame has none if too little is seen to find one: an
/// alignment by the root needs the root in answer and truth, and a fit needs three joints that are seen in both.
struct FrameFits {
  std::vector<std::optional<Similarity>> fits;
  std::size_t length = 1;  ///< number of successive frames that share one fit

  const std::optional<Similarity>& At(std::size_t frame) const { return fits[frame / length]; }
};

/// Finds the alignments of an answer. The constructor computes the sums and fits of single frames once, because most
/// alignments use them.
class PairFits {
 public:
  /// `pair` must outlive the object.
  explicit PairFits(const EvaluatedPair& pair);

  FrameFits Of(Alignment alignment) const;
  /// Fits a similarity to each segment of `length` frames, using only the segment's first `fitted` frames (W-MPJPE,
  /// WA-MPJPE). The last segment may be shorter.
  FrameFits OfSegments(std::size_t length, std::size_t fitted) const;

 private:
  FrameFits ByRoot(bool with_scale) const;

  const EvaluatedPair& pair_;
  std::vector<PointMoments> moments_;  // the sums over the joints of each frame
  std::vector<std::optional<Similarity>> each_frame_;
};

/// Returns the similarity with the least squared error; if `with_scale` is false, the rigid transformation with the
/// least squared error. Returns nothing for fewer than three points.
std::optional<Similarity> Fit(const PointMoments& moments, bool with_scale);

/// Returns the distance of each joint from its truth after the alignment, frames × joints, millimetres. It is NaN where
/// answer or truth is not seen, or the frame has no alignment.
std::vector<double> JointErrorsMm(const EvaluatedPair& pair, const FrameFits& fits);
/// Returns the mean of JointErrorsMm without the NaN values; nothing if all are NaN.
std::optional<double> MeanJointErrorMm(const EvaluatedPair& pair, const FrameFits& fits);

/// The alignments after which the errors of single joints are stored.
inline constexpr std::array kByJoint = {Alignment::kNone, Alignment::kRoot, Alignment::kFrameScaled};
/// The mean errors of a joint over the frames, millimetres, in the order of kByJoint; nullopt if JointErrorsMm has no
/// value.
using JointMeans = std::array<std::optional<double>, kByJoint.size()>;
/// The axis name of a series that a cell stores for each joint. The series holds the joint's means (EncodeMeans).
inline constexpr const char* kJointErrorAxis = "mean joint errors";
/// Encodes a missing mean as −1. DecodeMeans returns nullopt if the list has another length.
std::vector<double> EncodeMeans(const JointMeans& means);
std::optional<JointMeans> DecodeMeans(std::span<const double> values);
/// Returns the mean of one column of JointErrorsMm, which has `joints` columns; nothing if all its values are NaN.
std::optional<double> MeanOfJoint(std::span<const double> errors, std::size_t joints, std::size_t joint);

}  // namespace etude
