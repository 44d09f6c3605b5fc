#include "engine/formats/gltf/animation.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <set>
#include <string>
#include <vector>

#include "engine/base/names.h"
#include "engine/base/result.h"
#include "engine/formats/gltf/file.h"
#include "engine/formats/gltf/nodes.h"

namespace etude {
namespace {

/// The interpolation between an animation sampler's keys (glTF 2.0, appendix C).
enum class GltfInterpolation { kLinear, kStep, kCubicSpline };

/// One animated property over time: a translation or scale (three numbers), or a rotation (x, y, z, w).
class GltfCurve {
 public:
  using Value = std::array<double, 4>;

  /// Reads a sampler; `width` is 3, or 4 for rotations. Times may be equal, because keys that are nanoseconds apart
  /// coincide in single precision. Returns the errors of accessors, and an error for an unknown interpolation, times
  /// that descend, a number of values that does not fit the times, or a rotation of length 0.
  static Result<GltfCurve> Read(GltfFile& file, int animation, int sampler, std::size_t width);

  const std::vector<double>& times() const { return times_; }
  /// Returns the number of distinct times. Times that differ by microseconds count once; such times occur if a file has
  /// separate keys for three axes.
  std::size_t CountTimes() const;
  GltfInterpolation interpolation() const { return interpolation_; }
  /// Returns true if any key differs from the first by more than the rounding to floats.
  bool Moves() const;
  /// Returns the value at a time. Before the first key and after the last, the value is constant. Rotations have length
  /// 1.
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

constexpr double kMinRotationLength = 1e-9;

glm::dquat Quaternion(const double* xyzw) { return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]}; }

/// Returns the largest difference at which another time counts as equal to `time`. Files store times as floats.
double GltfTimeRounding(double time) { return 2e-7 * std::max(1.0, std::abs(time)); }

Result<GltfCurve> GltfCurve::Read(GltfFile& file, int animation, int sampler, std::size_t width) {
  const tinygltf::Animation& from = file.model().animations[static_cast<std::size_t>(animation)];
  const tinygltf::AnimationSampler& source = from.samplers[static_cast<std::size_t>(sampler)];
  const std::string where = fmt::format("animations[{}].samplers[{}]", animation, sampler);

  // Read the interpolation.
  GltfCurve curve;
  if (source.interpolation == "STEP") {
    curve.interpolation_ = GltfInterpolation::kStep;
  } else if (source.interpolation == "CUBICSPLINE") {
    curve.interpolation_ = GltfInterpolation::kCubicSpline;
  } else if (source.interpolation != "LINEAR") {
    return file.Refuse(where + ".interpolation", "found {}; allowed: LINEAR, STEP, CUBICSPLINE",
                       Quote(source.interpolation));
  }
  // Read the times and check that they do not descend.
  ASSIGN_OR_RETURN(auto times, file.Read(source.input, 1, GltfComponents::kFloat, where + ".input"));
  curve.times_ = std::move(times.values);
  for (std::size_t i = 1; i < curve.times_.size(); ++i) {
    if (!(curve.times_[i - 1] <= curve.times_[i])) {
      return file.Refuse(where + ".input",
                         "found the time {} s after the time {} s; allowed: times that do not decrease",
                         curve.times_[i], curve.times_[i - 1]);
    }
  }
  // Read the values; a spline has two tangents per key.
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
  // Check the rotations.
  for (std::size_t i = 0; is_rotation && i < curve.times_.size(); ++i) {
    const glm::dquat key = Quaternion(curve.Key(i));
    if (glm::dot(key, key) < kMinRotationLength * kMinRotationLength) {
      return file.Refuse(where + ".output", "found a rotation of length 0 at {} s; allowed: unit quaternions",
                         curve.times_[i]);
    }
  }
  return curve;
}

const double* GltfCurve::Key(std::size_t key) const {
  return interpolation_ == GltfInterpolation::kCubicSpline ? values_[3 * key + 1] : values_[key];
}

std::size_t GltfCurve::CountTimes() const {
  constexpr double kSame_s = 2e-5;
  std::size_t count = times_.empty() ? 0 : 1;
  for (std::size_t i = 1; i < times_.size(); ++i) {
    if (times_[i] - times_[i - 1] > kSame_s) ++count;
  }
  return count;
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
  // A spline between opposite quaternions may pass through zero; then use the value of the last key before this time.
  const glm::dquat found = Quaternion(value.data());
  if (glm::dot(found, found) < kMinRotationLength * kMinRotationLength) {
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

constexpr double kMaxFrameBytes = 200e6;  // limit for all clips together, bytes
constexpr double kMinRateHz = 0.1;
constexpr double kMaxRateHz = 10'000;
constexpr double kDefaultRateHz = 60;
constexpr std::size_t kMaxAnimations = 1000;

enum class Property { kTranslation, kRotation, kScale };

struct Channel {
  int joint = 0;
  Property property = Property::kTranslation;
  GltfCurve curve;
};

/// The sampling times of an animation.
struct Timing {
  double start = 0;
  double rate_hz = kDefaultRateHz;
  double frames = 1;  ///< number of frames, a whole number; it may exceed the allowed number
  double step = 0;    ///< mean time between the keys of the property with most keys, seconds
};

void Apply(const Channel& channel, double time, LocalPose& pose) {
  const GltfCurve::Value value = channel.curve.At(time);
  LocalTransform& local = pose[channel.joint];
  switch (channel.property) {
    case Property::kTranslation:
      local.translation = {value[0], value[1], value[2]};
      break;
    case Property::kRotation:
      local.rotation = {value[3], value[0], value[1], value[2]};
      break;
    case Property::kScale:
      local.scale = {value[0], value[1], value[2]};
      break;
  }
}

/// Rounds a rate to a nearby whole number, else to thousandths, because times are floats with few digits.
double RoundedRate(double rate) {
  constexpr double kPrintedPrecision = 1e-4;
  const double whole = std::round(rate);
  return std::abs(rate - whole) < kPrintedPrecision * whole ? whole : std::round(rate * 1000) / 1000;
}

bool LiesOnGrid(const std::vector<double>& times, double start, double rate_hz) {
  constexpr double kSlack = 0.02;  // tolerance, as a share of a frame
  return std::ranges::all_of(times, [&](double time) {
    const double frame = (time - start) * rate_hz;
    return std::abs(frame - std::round(frame)) <= kSlack + rate_hz * GltfTimeRounding(time);
  });
}

/// Returns the rate of the keys if all moving properties are linear with evenly spaced keys, because sampling at this
/// rate loses no information; otherwise returns the default rate. Steps count as linear if they last one usual frame.
double RateOf(const std::vector<Channel>& channels, double start) {
  // Exporters give resting joints only two keys, at the beginning and at the end. These keys say nothing about the
  // rate.
  const bool any_moves = std::ranges::any_of(channels, [](const Channel& channel) { return channel.curve.Moves(); });
  const auto counts = [&](const Channel& channel) { return !any_moves || channel.curve.Moves(); };
  constexpr double kMinStepRateHz = 24;
  double min_rate_hz = kMinRateHz;
  const GltfCurve* densest = nullptr;
  for (const Channel& channel : channels) {
    if (!counts(channel)) continue;
    if (any_moves && channel.curve.interpolation() == GltfInterpolation::kCubicSpline) return kDefaultRateHz;
    if (any_moves && channel.curve.interpolation() == GltfInterpolation::kStep) min_rate_hz = kMinStepRateHz;
    if (!densest || channel.curve.CountTimes() > densest->CountTimes()) densest = &channel.curve;
  }
  const std::vector<double>& times = densest->times();
  const std::size_t count = densest->CountTimes();
  if (count < 2) return kDefaultRateHz;
  const double rate = RoundedRate(static_cast<double>(count - 1) / (times.back() - times.front()));
  if (rate < min_rate_hz || rate > kMaxRateHz) return kDefaultRateHz;
  for (const Channel& channel : channels) {
    if (counts(channel) && !LiesOnGrid(channel.curve.times(), start, rate)) return kDefaultRateHz;
  }
  return rate;
}

Timing TimingOf(const std::vector<Channel>& channels) {
  double start = channels.front().curve.times().front();
  double end = start;
  std::size_t keys = 2;
  for (const Channel& channel : channels) {
    start = std::min(start, channel.curve.times().front());
    end = std::max(end, channel.curve.times().back());
    keys = std::max(keys, channel.curve.CountTimes());
  }
  const double rate = RateOf(channels, start);
  constexpr double kSlack = 0.02;  // tolerance, as a share of a frame, as in LiesOnGrid
  return {start, rate, std::floor((end - start) * rate + kSlack) + 1, (end - start) / static_cast<double>(keys - 1)};
}

class ClipReader {
 public:
  ClipReader(GltfFile& file, const GltfNodes& nodes, std::vector<std::string>& remarks)
      : file_(file), nodes_(nodes), remarks_(remarks) {}

  Result<std::vector<Clip>> Read() {
    const std::size_t count = file_.model().animations.size();
    if (count > kMaxAnimations) {
      return file_.Refuse("animations", "found {}; allowed: at most {}", count, kMaxAnimations);
    }
    for (int i = 0; i < static_cast<int>(count); ++i) {
      ASSIGN_OR_RETURN(auto channels, ReadChannels(i));
      if (channels.empty()) continue;
      RETURN_IF_ERROR(Sample(i, channels));
    }
    return std::move(clips_);
  }

 private:
  const tinygltf::Animation& At(int index) const { return file_.model().animations[static_cast<std::size_t>(index)]; }

  Result<std::vector<Channel>> ReadChannels(int index) {
    const tinygltf::Animation& animation = At(index);
    std::vector<Channel> channels;
    // Read each channel's target and curve.
    for (std::size_t i = 0; i < animation.channels.size(); ++i) {
      const tinygltf::AnimationChannel& source = animation.channels[i];
      if (source.target_node == kNoIndex) continue;  // the channel has no target node
      const std::string where = fmt::format("animations[{}].channels[{}]", index, i);
      RETURN_IF_ERROR(file_.CheckIndex(source.sampler, animation.samplers.size(), where + ".sampler"));
      Property property;
      if (source.target_path == "translation") {
        property = Property::kTranslation;
      } else if (source.target_path == "rotation") {
        property = Property::kRotation;
      } else if (source.target_path == "scale") {
        property = Property::kScale;
      } else if (source.target_path == "weights") {
        continue;  // weights of morph targets are not read
      } else {
        return file_.Refuse(where + ".target.path", "found {}; allowed: translation, rotation, scale, weights",
                            Quote(source.target_path));
      }
      // Refuse a second channel for the same property, then read the curve.
      const int joint = nodes_.joint_of[source.target_node];
      if (joint < 0) continue;  // a node that holds only a skinned mesh is not a joint
      const bool is_double = std::ranges::any_of(
          channels, [&](const Channel& other) { return other.joint == joint && other.property == property; });
      if (is_double) {
        return file_.Refuse(where, "found a second channel for the {} of node {}; allowed: one channel",
                            source.target_path, source.target_node);
      }
      ASSIGN_OR_RETURN(auto curve,
                       GltfCurve::Read(file_, index, source.sampler, property == Property::kRotation ? 4 : 3));
      channels.push_back({joint, property, std::move(curve)});
    }
    return channels;
  }

  Result<void> Sample(int index, const std::vector<Channel>& channels) {
    const std::string where = fmt::format("animations[{}]", index);
    const Timing timing = TimingOf(channels);
    const std::size_t joints = nodes_.skeleton.joints.size();
    frame_bytes_ += timing.frames * static_cast<double>(joints * sizeof(LocalTransform));
    if (frame_bytes_ > kMaxFrameBytes) {
      return file_.Refuse(
          where,
          "this animation has {} frames of {} joints, which brings all animations to {:.0f} MB; allowed: at most "
          "{:.0f} MB{}",
          timing.frames, joints, frame_bytes_ / 1e6, kMaxFrameBytes / 1e6,
          timing.step > 1 ? fmt::format("; the keys are {:.3g} s apart: are the times in milliseconds?", timing.step)
                          : "");
    }
    Clip clip{.name = UniqueName(index), .skeleton = nodes_.skeleton, .rate_hz = timing.rate_hz, .frames = {}};
    clip.frames.assign(static_cast<std::size_t>(timing.frames), RestPose(clip.skeleton));
    for (std::size_t k = 0; k < clip.frames.size(); ++k) {
      const double time = timing.start + static_cast<double>(k) / timing.rate_hz;
      for (const Channel& channel : channels) Apply(channel, time, clip.frames[k]);
      if (auto ok = CheckGltfPose(file_, clip.skeleton, clip.frames[k], fmt::format("{} at {} s", where, time)); !ok) {
        return ok;
      }
    }
    constexpr double kLate_s = 0.1;  // some exporters put the first frame at the time of frame 1
    if (timing.start > kLate_s) {
      remarks_.push_back(fmt::format("the first key of {} is at {:.3g} s; Etude uses this time as time 0",
                                     Quote(clip.name), timing.start));
    }
    clips_.push_back(std::move(clip));
    return {};
  }

  /// Returns the animation's name as in the file. An unnamed animation is named by its index, and a number is appended
  /// to duplicate names.
  std::string UniqueName(int index) {
    const std::string& given = At(index).name;
    const std::string base = given.empty() ? fmt::format("animation_{}", index) : given;
    std::string name = base;
    for (int number = 2; !names_.insert(name).second; ++number) name = fmt::format("{}_{}", base, number);
    if (name != base)
      remarks_.push_back(
          fmt::format("two animations are named {}; Etude renames the second to {}", Quote(base), Quote(name)));
    return name;
  }

  GltfFile& file_;
  const GltfNodes& nodes_;
  double frame_bytes_ = 0;
  std::set<std::string> names_;
  std::vector<std::string>& remarks_;
  std::vector<Clip> clips_;
};

}  // namespace

Result<std::vector<Clip>> ReadGltfClips(GltfFile& file, const GltfNodes& nodes, std::vector<std::string>& remarks) {
  return ClipReader(file, nodes, remarks).Read();
}

}  // namespace etude
