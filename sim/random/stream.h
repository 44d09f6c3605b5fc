#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "sim/random/seed.h"

namespace etude {

/// The key of a world's dice: never the method, so that every method meets the same world, and never the condition's
/// values, so that a sweep changes strengths, not the dice. Secret worlds alone have dice of their own for every
/// condition: `scenario` then names the condition, too.
struct WorldKey {
  Seed suite_seed = 1;
  std::string_view scenario;
  int trial = 0;
};

/// A stream of random numbers that depends on its key alone (counter-based: Philox 4×64-10 of
/// Random123, Salmon et al. 2011), the same on every machine. Under a secret seed it is Threefish-256 in counter mode,
/// under a key that the cipher makes of the secret and of all that names the stream: who sees all numbers of all other
/// streams knows nothing of this one's. Distributions are our own, because the standard library's differ from one
/// implementation to the next.
class RandomStream {
 public:
  /// Makes the stream of one purpose, independent of all others, e.g. "joint-noise" or "camera-0/pixel-noise".
  RandomStream(const WorldKey& world, std::string_view purpose);

  std::uint64_t Bits();
  /// Fills `out` as that many calls of Bits() would, but faster.
  void FillBits(std::span<std::uint64_t> out);
  /// Draws a number uniform in [0, 1), of 53 bits.
  double Uniform();
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  /// Draws a standard normal number (Box–Muller, both values used).
  double Normal();
  double Normal(double mean, double deviation) { return mean + deviation * Normal(); }
  /// Draws three independent standard normal numbers.
  glm::dvec3 Normal3();
  /// Draws a number uniform in {0, …, count − 1}, unbiased; `count` > 0.
  std::uint64_t IndexBelow(std::uint64_t count);
  bool Chance(double probability) { return Uniform() < probability; }

 private:
  Words256 Block(std::uint64_t counter) const;

  Words256 key_{};  ///< Philox takes two of them
  bool is_secret_ = false;
  std::uint64_t counter_ = 0;
  Words256 block_{};
  int used_ = 4;
  bool has_spare_normal_ = false;
  double spare_normal_ = 0;
};

}  // namespace etude
