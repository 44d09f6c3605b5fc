#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "sim/random/seed.h"

namespace etude {

/// The key of a world's random numbers. The key excludes the method, so that every method gets the same world. The key
/// also excludes the values of swept parameters, so that a sweep changes strengths but not random numbers. Only with a
/// secret seed does every condition have its own numbers; `scenario` then includes the condition.
struct WorldKey {
  Seed suite_seed = 1;
  std::string_view scenario;
  int trial = 0;
};

/// A stream of random numbers that depends only on its key and is the same on every machine (counter-based: Philox
/// 4×64-10 of Random123, Salmon et al. 2011). With a secret seed, the stream is Threefish-256 in counter mode; its key
/// is derived with the cipher from the secret and from all names of the stream. The numbers of all other streams then
/// reveal nothing about this one. The distributions are our own, because the distributions of standard libraries
/// differ.
class RandomStream {
 public:
  /// Makes the stream of one purpose, such as "joint-noise" or "camera-0/pixel-noise". The stream is independent of all
  /// other streams. The seed must be open (Seed::IsOpen).
  RandomStream(const WorldKey& world, std::string_view purpose);

  std::uint64_t Bits();
  /// Fills `out` with the results of out.size() calls of Bits(), but faster.
  void FillBits(std::span<std::uint64_t> out);
  /// Draws a uniform number in [0, 1) with 53 random bits.
  double Uniform();
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  /// Draws a standard normal number (Box–Muller; both values of a pair are used).
  double Normal();
  double Normal(double mean, double deviation) { return mean + deviation * Normal(); }
  /// Draws three independent standard normal numbers.
  glm::dvec3 Normal3();
  /// Draws a uniform number in {0, …, count − 1} without bias. `count` must be > 0.
  std::uint64_t IndexBelow(std::uint64_t count);
  bool Chance(double probability) { return Uniform() < probability; }

 private:
  Words256 Block(std::uint64_t counter) const;

  Words256 key_{};  ///< the key; Philox uses only the first two words
  bool is_secret_ = false;
  std::uint64_t counter_ = 0;
  Words256 block_{};
  int used_ = 4;
  bool has_spare_normal_ = false;
  double spare_normal_ = 0;
};

}  // namespace etude
