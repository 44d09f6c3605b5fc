#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"
#include "sim/random/stream.h"

namespace etude {

/// A random function of time with mean 0 and standard deviation 1. Half of its variance comes from a constant. The rest
/// is a cubic B-spline with a new random coefficient every half second, so the function is twice continuously
/// differentiable.
class SmoothRandomFunction {
 public:
  SmoothRandomFunction(const WorldKey& key, std::string_view purpose);
  /// Returns the value at a time ≥ 0, seconds.
  double At(double seconds);

 private:
  RandomStream dice_;
  const double constant_;
  std::vector<double> knots_;
};

/// Returns the pose at a fractional `frame`, interpolated linearly between two frames of the clip. After its last
/// frame, the clip continues with its first one.
BodyPose PoseOfClip(std::span<const BodyPose> clip, double frame);

/// Changes the clip of a secret world. Otherwise, a program that knows all public clips could recognise the clip and
/// would know the truth. The body is scaled by up to ± 1/12. The clip is played up to a seventh slower and starts
/// between two frames. Every limb, with all limbs attached to it, is turned by random angles that vary over time: about
/// 3° in hips and trunk, 6° in arms. Limb lengths change by the scale alone. Elbows and knees bend about a fifth more
/// or less and never hyperextend. The height of the lowest joint changes by the scale alone. Worlds that are not
/// secret are not disguised.
class Disguise {
 public:
  /// `key.scenario` must outlive this object.
  explicit Disguise(const WorldKey& key);

  double scale() const { return scale_; }
  /// Returns the fractional frame of the clip that is played as frame `count` of a window. Without a disguise this is
  /// `start` + `count` · `step`. The result is at most `last`.
  double FrameOf(double start, double step, std::size_t count, double last) const;
  /// Turns the limbs in all frames of a window, and scales the body.
  void ApplyTo(std::vector<BodyPose>& window, double rate_hz) const;

 private:
  const WorldKey key_;
  double scale_, pace_, offset_;
};

}  // namespace etude
