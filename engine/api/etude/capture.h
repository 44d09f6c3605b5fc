#pragma once

#include <etude/cameras.h>
#include <etude/motion.h>

#include <span>
#include <string>
#include <vector>

namespace etude::engine {

struct Keypoint {
  glm::dvec2 pixel{0};
  double confidence = 0;  ///< 0: not seen, 1: sure
};

/// One person in one picture: the keypoints in the order of a layout.
using SeenPerson = std::vector<Keypoint>;
/// Everybody that one camera saw, frame by frame, in any order.
using SeenPeople = std::vector<std::vector<SeenPerson>>;

struct CaptureOptions {
  std::string layout = "coco";  ///< or "body_25", "body_25b", "halpe_26", "halpe_26_hands"
  double rate_hz = 30;
  int person = 0;        ///< of those found, the one seen most first
  double smooth_hz = 0;  ///< motion above this is smoothed away; 0: none is
};

struct CapturedMotion {
  Motion motion;
  std::string bvh;            ///< the same as a BVH file with turning joints, metres, of the person's own skeleton
  std::vector<bool> is_held;  ///< frames of which nothing could be recovered, and which show the last pose
  double residual_px = 0;     ///< of the triangulated keypoints, median
};

/// Recovers a person's motion from keypoints of two or more cameras that ran at the same time: people are told apart
/// over time and cameras, keypoints that disagree left out, gaps bridged, and the person's own skeleton fitted. Throws
/// BadInput for inputs that do not fit each other, and where nobody is seen by two cameras.
/// @param seen of each camera, as many frames
ETUDE_API CapturedMotion Capture(std::span<const Camera> cameras, std::span<const SeenPeople> seen,
                                 const CaptureOptions& options = {});

}  // namespace etude::engine
