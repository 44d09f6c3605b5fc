#pragma once

#include <array>

#include "sim/choreography/controls.h"
#include "sim/random/stream.h"

namespace etude {

/// Nobody stands like a post: weight wanders from foot to foot, the chest breathes, the head looks about.
class Sway {
 public:
  explicit Sway(RandomStream& random);

  /// What it adds to a standing body, seconds after the session's first frame.
  Controls At(double time_s) const;

 private:
  std::array<double, 5> phases_{};
};

}  // namespace etude
