#pragma once

#include <memory>

#include "engine/base/image.h"

namespace etude {

// What is compared with OpenCV, as OpenCV's users would write it: its own functions, buffers kept, one thread.

/// Finds a person by hue in pictures of one camera: the background's part computed once, the largest contour, its small
/// holes filled.
class OpenCvPerson {
 public:
  enum class Kind {
    kSameHue,      ///< the paper's hue, by OpenCV's arithmetic on whole pictures: the same masks as ours
    kHsv,          ///< cvtColor's hue of 180 steps: what one takes who wants it fast
    kHsvContours,  ///< the same, the largest piece by contours alone instead of labels
  };
  OpenCvPerson(const ColourImage& background, double hue_threshold, int max_hole_px, Kind kind);
  ~OpenCvPerson();
  OpenCvPerson(OpenCvPerson&&) noexcept;
  OpenCvPerson& operator=(OpenCvPerson&&) = delete;

  Mask Find(const ColourImage& picture);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// MOG2 or KNN, shadows told apart, with the same largest piece and holes.
class OpenCvModel {
 public:
  enum class Kind { kMog2, kKnn };
  OpenCvModel(Kind kind, int max_hole_px);
  ~OpenCvModel();
  OpenCvModel(OpenCvModel&&) noexcept;
  OpenCvModel& operator=(OpenCvModel&&) = delete;

  Mask Find(const ColourImage& picture);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace etude
