#pragma once

#include <memory>

#include "engine/base/image.h"

namespace etude {

// The peers use OpenCV as its users would: with OpenCV's functions, reused buffers and one thread.

/// Finds a person by hue in pictures of one camera: the largest changed piece, with its small holes filled. Everything
/// that depends on the background alone is computed once.
class OpenCvPerson {
 public:
  enum class Kind {
    kSameHue,      ///< the paper's hue by OpenCV's arithmetic on whole pictures; gives the same masks as Etude's
    kHsv,          ///< the hue of cvtColor, in 180 steps; faster than kSameHue
    kHsvContours,  ///< kHsv, but the largest piece is found by contours instead of labels
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

/// Finds a person with OpenCV's background models MOG2 and KNN with shadow detection. The person is the largest piece,
/// with small holes filled.
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
