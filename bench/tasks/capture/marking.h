#pragma once

#include <vector>

#include "bench/metrics/annotation.h"
#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/world.h"
#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "engine/vision/limb_colours.h"
#include "engine/vision/strokes.h"
#include "sim/annotator/annotator.h"
#include "sim/random/stream.h"

namespace etude {

/// The annotators of one take, for one way of cutting out the person. Each annotator draws on pictures of their own,
/// which are then read back (`ReadMarks`). Two markings of the same world use the same random draws, whatever pictures
/// they are shown.
class Marking {
 public:
  /// `key` must outlive this. The world gives the number of cameras and the kind of figure: where joints are in its
  /// limbs, and which point of its head is marked.
  Marking(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key);

  /// Marks one picture and returns the marks as methods receive them: the mean of both annotators' marks if both drew a
  /// stroke or disc, else the only one. Empty in frames that are not marked. A camera's frames come in order.
  Marks Mark(std::size_t camera, std::size_t frame, const AnnotatedPicture& picture);

  /// Returns exact marks, at the joints of `pose`, for the limbs and ends that the picture shows, without drawing. Uses
  /// no random draws.
  Marks MarkTrueJoints(std::size_t frame, const AnnotatedPicture& picture, const Camera& camera,
                       const BodyPose& pose) const;

  /// Returns the marks that the colours of the coded suit give, for a performer who wears it. Uses no random draws.
  Marks ReadColours(std::size_t frame, const AnnotatedPicture& picture) const;

  /// The marks of both annotators for each joint and each limb in all pictures so far; empty with a single annotator.
  const std::vector<MarkedTwice>& joints() const { return joints_; }
  const std::vector<MarkedTwice>& limbs() const { return limbs_; }

 private:
  void Compare(const Marks& first, const Marks& second);

  std::size_t mark_every_;
  EvidenceOptions eye_;
  LimbColours suit_;
  std::vector<std::vector<Annotator>> annotators_;  // [camera][annotator]
  std::vector<MarkedTwice> joints_, limbs_;
};

/// Returns `FigureLook::head_below_crown` of a performer in the pose `body`. Like limb lengths it is the same in every
/// pose and measured beforehand.
double HeadBelowCrown(const Figure& figure, const BodyPose& body);

/// Returns the mean of both marks for each stroke and disc, or the only one.
Marks MeanMarks(const Marks& first, const Marks& second);

}  // namespace etude
