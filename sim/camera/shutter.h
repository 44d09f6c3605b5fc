#pragma once

#include <vector>

#include "sim/camera/camera_effects.h"
#include "sim/random/stream.h"
#include "sim/render/renderer.h"

namespace etude {

/// When a camera looks. Times are told in frames of the reference clock, which the truth is told by: frame k of a
/// faultless camera is taken at k.
class Shutter {
 public:
  /// @param is_reference the camera whose clock is right; the others' offset and drift have a sign by throws, their
  ///        size is the effect's
  Shutter(const CameraEffects& effects, double rate_hz, bool is_reference, RandomStream& random);

  /// When the middle row of the camera's own frame k is taken: k (1 + drift) + offset.
  double TimeOf(std::size_t frame) const;

  /// Rows that are taken at one time.
  struct Band {
    RowRange rows;
    double time = 0;
  };
  /// A rolling shutter reads row after row, from the top. It is drawn in kBands bands, each at the time of its middle;
  /// without one there is a single band.
  std::vector<Band> BandsOf(std::size_t frame, int height) const;
  static constexpr int kBands = 8;

  /// While the shutter is open, the times whose pictures are averaged: kSubframes of them, evenly spread about the
  /// band's; one without motion blur.
  std::vector<double> SubframesOf(const Band& band) const;
  static constexpr int kSubframes = 9;

 private:
  double offset_ = 0;    ///< frames
  double drift_ = 0;     ///< frames per frame
  double read_out_ = 0;  ///< frames from the first row to the last
  double open_ = 0;      ///< frames
};

}  // namespace etude
