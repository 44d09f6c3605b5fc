#include "engine/formats/gltf/curve.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "engine/base/names.h"
#include "engine/formats/gltf/nodes.h"

namespace etude {
namespace {

constexpr double kShortestRotation = 1e-9;

glm::dquat Quaternion(const double* xyzw) { return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]}; }

}  // namespace

double GltfTimeRounding(double time) { return 2e-7 * std::max(1.0, std::abs(time)); }

Result<GltfCurve> GltfCurve::Read(GltfFile& file, int animation, int sampler, std::size_t width) {
  const tinygltf::Animation& from = file.model().animations[static_cast<std::size_t>(animation)];
  const tinygltf::AnimationSampler& source = from.samplers[static_cast<std::size_t>(sampler)];
  const std::string where = fmt::format("animations[{}].samplers[{}]", animation, sampler);

  GltfCurve curve;
  if (source.interpolation == "STEP") {
    curve.interpolation_ = GltfInterpolation::kStep;
  } else if (source.interpolation == "CUBICSPLINE") {
    curve.interpolation_ = GltfInterpolation::kCubicSpline;
  } else if (source.interpolation != "LINEAR") {
    return file.Refuse(where + ".interpolation", "found {}; allowed: LINEAR, STEP, CUBICSPLINE",
                       Quote(source.interpolation));
  }
  ASSIGN_OR_RETURN(auto times, file.Read(source.input, 1, GltfComponents::kFloat, where + ".input"));
  curve.times_ = std::move(times.values);
  for (std::size_t i = 1; i < curve.times_.size(); ++i) {
    if (!(curve.times_[i - 1] < curve.times_[i])) {
      return file.Refuse(where + ".input", "found {} s after {} s; allowed: times that ascend", curve.times_[i],
                         curve.times_[i - 1]);
    }
  }
  const bool is_rotation = width == 4;
  ASSIGN_OR_RETURN(auto values, file.Read(source.output, width,
                                          is_rotation ? GltfComponents::kFloatOrNormalized : GltfComponents::kFloat,
                                          where + ".output"));
  curve.values_ = std::move(values);
  const std::size_t per_key = curve.interpolation_ == GltfInterpolation::kCubicSpline ? 3 : 1;
  if (curve.values_.Count() != per_key * curve.times_.size()) {
    return file.Refuse(where + ".output", "found {} values; {} times need {}", curve.values_.Count(),
                       curve.times_.size(), per_key * curve.times_.size());
  }
  for (std::size_t i = 0; is_rotation && i < curve.times_.size(); ++i) {
    const glm::dquat key = Quaternion(curve.Key(i));
    if (glm::dot(key, key) < kShortestRotation * kShortestRotation) {
      return file.Refuse(where + ".output", "found a rotation of length 0 at {} s; allowed: unit quaternions",
                         curve.times_[i]);
    }
  }
  return curve;
}

const double* GltfCurve::Key(std::size_t key) const {
  return interpolation_ == GltfInterpolation::kCubicSpline ? values_[3 * key + 1] : values_[key];
}

bool GltfCurve::Moves() const {
  constexpr double kRounding = 1e-6;
  const double* first = Key(0);
  for (std::size_t i = 1; i < times_.size(); ++i) {
    for (std::size_t k = 0; k < values_.width; ++k) {
      if (std::abs(Key(i)[k] - first[k]) > kRounding * std::max(1.0, std::abs(first[k]))) return true;
    }
  }
  return false;
}

GltfCurve::Value GltfCurve::At(double time) const {
  const double rounding = GltfTimeRounding(time);
  const auto after = std::ranges::upper_bound(times_, time + rounding);
  const std::size_t key = after == times_.begin() ? 0 : static_cast<std::size_t>(after - times_.begin()) - 1;
  Value at_key{};
  std::copy_n(Key(key), values_.width, at_key.begin());
  const bool is_at_key = time - times_[key] <= rounding || key + 1 == times_.size();
  if (is_at_key || interpolation_ == GltfInterpolation::kStep) return Finished(at_key, key);

  const double seconds = times_[key + 1] - times_[key];
  const double fraction = (time - times_[key]) / seconds;
  if (interpolation_ == GltfInterpolation::kCubicSpline) return Finished(Spline(key, fraction, seconds), key);
  if (values_.width == 4) return Slerp(key, fraction);
  for (std::size_t k = 0; k < values_.width; ++k) at_key[k] += fraction * (Key(key + 1)[k] - at_key[k]);
  return at_key;
}

GltfCurve::Value GltfCurve::Finished(Value value, std::size_t fallback_key) const {
  if (values_.width != 4) return value;
  // A spline between opposite quaternions may pass through zero.
  const glm::dquat found = Quaternion(value.data());
  if (glm::dot(found, found) < kShortestRotation * kShortestRotation) {
    std::copy_n(Key(fallback_key), values_.width, value.begin());
  }
  const glm::dquat unit = RotationFrom(value.data());
  return {unit.x, unit.y, unit.z, unit.w};
}

GltfCurve::Value GltfCurve::Slerp(std::size_t key, double fraction) const {
  const glm::dquat turned = glm::slerp(RotationFrom(Key(key)), RotationFrom(Key(key + 1)), fraction);
  const glm::dquat unit = glm::normalize(turned);
  return {unit.x, unit.y, unit.z, unit.w};
}

GltfCurve::Value GltfCurve::Spline(std::size_t key, double t, double seconds) const {
  const double* from = Key(key);
  const double* leaving = values_[3 * key + 2];
  const double* arriving = values_[3 * (key + 1)];
  const double* to = Key(key + 1);
  const double t2 = t * t;
  const double t3 = t2 * t;
  Value value{};
  for (std::size_t k = 0; k < values_.width; ++k) {
    value[k] = (2 * t3 - 3 * t2 + 1) * from[k] + seconds * (t3 - 2 * t2 + t) * leaving[k] + (-2 * t3 + 3 * t2) * to[k] +
               seconds * (t3 - t2) * arriving[k];
  }
  return value;
}

}  // namespace etude
