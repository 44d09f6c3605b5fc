#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/gltf/file.h"

namespace etude {

/// What an animation sampler says between its keys (glTF 2.0, appendix C).
enum class GltfInterpolation { kLinear, kStep, kCubicSpline };

/// One animated property over time: three numbers of a translation or scale, or a rotation's x, y, z, w.
class GltfCurve {
 public:
  using Value = std::array<double, 4>;

  /// Reads a sampler; `width` is 3, or 4 for rotations. Refused, besides what accessors can have wrong: an unknown
  /// interpolation, times that do not ascend, as many values as do not fit the times, rotations of length 0.
  static Result<GltfCurve> Read(GltfFile& file, int animation, int sampler, std::size_t width);

  const std::vector<double>& times() const { return times_; }
  GltfInterpolation interpolation() const { return interpolation_; }
  /// Whether any key differs from the first by more than files' floats do.
  bool Moves() const;
  /// The value at a time, held before the first key and after the last. Rotations are unit.
  Value At(double time) const;

 private:
  const double* Key(std::size_t key) const;
  Value Finished(Value value, std::size_t fallback_key) const;
  Value Slerp(std::size_t key, double fraction) const;
  Value Spline(std::size_t key, double fraction, double seconds) const;

  GltfInterpolation interpolation_ = GltfInterpolation::kLinear;
  std::vector<double> times_;
  GltfNumbers values_;
};

/// Times in files are floats: what is nearer than this is the same moment.
double GltfTimeRounding(double time);

}  // namespace etude
