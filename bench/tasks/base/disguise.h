#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"
#include "sim/random/stream.h"

namespace etude {

/// A random function of time with mean 0 and standard deviation 1. Half of its variance is a constant; the rest is a
/// cubic spline with a new random knot every half second, so the function is twice continuously differentiable.
class WanderingDice {
 public:
  WanderingDice(const WorldKey& key, std::string_view purpose);
  /// Returns the value at a time ≥ 0, seconds.
  double At(double seconds);

 private:
  RandomStream dice_;
  const double constant_;
  std::vector<double> knots_;
};

/// Returns the pose at a fractional `frame`, interpolated linearly between two frames of the clip; past its end the
/// clip continues from its beginning.
BodyPose PoseOfClip(std::span<const BodyPose> clip, double frame);

/// Changes the clip of a secret world, because a program that knows all public clips could recognise one and would know
/// its truth *(ours)*. The body is scaled by up to ± 1/12 and plays the clip up to a seventh slower, starting between
/// two frames. Every limb, with all limbs attached to it, is turned by random angles that vary in time: about 3° in
/// hips and trunk, 6° in arms. Limb lengths change by the scale alone; elbows and knees bend about a fifth more or less
/// and never hyperextend; the lowest joint keeps its height. Worlds of plain seeds are not disguised.
class Disguise {
 public:
  /// `key.scenario` must outlive this.
  explicit Disguise(const WorldKey& key);

  double scale() const { return scale_; }
  /// Returns the fractional frame of the clip that is played as frame `count` of a window. Without a disguise it would
  /// be `start` + `count` · `step`; it is at most `last`.
  double FrameOf(double start, double step, std::size_t count, double last) const;
  /// Turns the limbs of a window and scales it.
  void ApplyTo(std::vector<BodyPose>& window, double rate_hz) const;

 private:
  const WorldKey key_;
  double scale_, pace_, offset_;
};

}  // namespace etude
