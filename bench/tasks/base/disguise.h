#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"
#include "sim/random/stream.h"

namespace etude {

/// A number that wanders as time goes by: mean 0, standard deviation 1, half of its variance constant, the rest settled
/// anew every half second. Twice continuously differentiable.
class WanderingDice {
 public:
  WanderingDice(const WorldKey& key, std::string_view purpose);
  /// Returns the number at a time from 0 on.
  double At(double seconds);

 private:
  RandomStream dice_;
  const double constant_;
  std::vector<double> knots_;
};

/// Returns the pose at `frame`, on straight lines between two frames of the clip; a loop goes on from its beginning.
BodyPose PoseOfClip(std::span<const BodyPose> clip, double frame);

/// What a secret world makes of a clip, since whoever knows all public clips would recognise one and know its truth
/// *(ours)*. The body is larger or smaller by up to a twelfth, plays the clip up to a seventh slower, begins between
/// two frames, and every limb is turned by wandering angles of its own, some 3° in hips and trunk and 6° in arms, with
/// all that hangs on it. Limbs keep their length but for the scale; elbows and knees are bent by about a fifth more or
/// less and never overstretched; the lowest joint is as high as it was. Worlds of plain seeds have none.
class Disguise {
 public:
  /// `key.scenario` must outlive this.
  explicit Disguise(const WorldKey& key);

  double scale() const { return scale_; }
  /// Returns the frame of the clip that is played as number `count`, when a window begins at `start` and takes every
  /// `step`-th; not beyond `last`.
  double FrameOf(double start, double step, std::size_t count, double last) const;
  /// Turns the limbs of a window, and scales it.
  void PutOn(std::vector<BodyPose>& window, double rate_hz) const;

 private:
  const WorldKey key_;
  double scale_, pace_, late_;
};

}  // namespace etude
