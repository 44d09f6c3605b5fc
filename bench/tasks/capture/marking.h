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

/// The annotators who mark the pictures of one take. In these pictures, one PersonSource has cut out the person. Each
/// annotator draws on copies of the pictures, and the marks are then read back from the copies (`ReadMarks`). Two
/// Markings of the same world use the same random draws, whatever pictures they receive.
class Marking {
 public:
  /// `key` must outlive this object. The world determines the number of cameras and the kind of figure. The figure
  /// determines where its joints lie in its limbs, and which point of its head is marked.
  Marking(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key);

  /// Marks one picture and returns the marks as methods receive them. Where both annotators drew a stroke or disc, the
  /// result is the mean of the two; where only one annotator drew, the result is that mark. The result is empty if the
  /// frame is not marked. The frames of a camera must come in order.
  Marks Mark(std::size_t camera, std::size_t frame, const AnnotatedPicture& picture);

  /// Returns exact marks at the joints of `pose`, for the limbs and ends that are visible in the picture. Nothing is
  /// drawn, and no random numbers are used.
  Marks MarkTrueJoints(std::size_t frame, const AnnotatedPicture& picture, const Camera& camera,
                       const BodyPose& pose) const;

  /// Returns the marks that are found by the colours of the coded suit. The performer must wear it. Uses no random
  /// numbers.
  Marks ReadColours(std::size_t frame, const AnnotatedPicture& picture) const;

  /// Returns the marks of both annotators for each joint in all pictures so far; `limbs` returns them for each limb.
  /// The two lists are empty if there is a single annotator.
  const std::vector<MarkedTwice>& joints() const { return joints_; }
  const std::vector<MarkedTwice>& limbs() const { return limbs_; }

 private:
  void Compare(const Marks& first, const Marks& second);

  std::size_t mark_every_;
  EvidenceOptions eye_;
  LimbColours suit_;
  std::vector<std::vector<Annotator>> annotators_;  // indexed [camera][annotator]
  std::vector<MarkedTwice> joints_, limbs_;
};

/// Returns `FigureLook::head_below_crown` of a performer in the pose `body`: the distance of the head joint below the
/// crown, in half widths of the head. Like the limb lengths, it is the same in every pose and is measured beforehand.
double HeadBelowCrown(const Figure& figure, const BodyPose& body);

/// Returns the mean of the two annotators' marks for each stroke and disc, or the single mark if only one annotator
/// drew it.
Marks MeanMarks(const Marks& first, const Marks& second);

}  // namespace etude
