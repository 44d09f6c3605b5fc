#include "engine/formats/gltf/animation.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/base/names.h"
#include "engine/formats/gltf/curve.h"

namespace etude {
namespace {

constexpr double kMostFrameBytes = 200e6;  // of all clips together
constexpr double kLowestRateHz = 0.1;
constexpr double kHighestRateHz = 10'000;
constexpr double kDefaultRateHz = 60;
constexpr std::size_t kMostAnimations = 1000;

enum class Property { kTranslation, kRotation, kScale };

struct Channel {
  int joint = 0;
  Property property = Property::kTranslation;
  GltfCurve curve;
};

/// When to sample.
struct Timing {
  double start = 0;
  double rate_hz = kDefaultRateHz;
  double frames = 1;  ///< a whole number, which may be far too large
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

/// A whole number when it is nearly one, else in thousandths: times are floats, which leave no more digits.
double RoundedRate(double rate) {
  constexpr double kPrintedPrecision = 1e-4;
  const double whole = std::round(rate);
  return std::abs(rate - whole) < kPrintedPrecision * whole ? whole : std::round(rate * 1000) / 1000;
}

bool LiesOnGrid(const std::vector<double>& times, double start, double rate_hz) {
  constexpr double kSlack = 0.02;  // of a frame
  return std::ranges::all_of(times, [&](double time) {
    const double frame = (time - start) * rate_hz;
    return std::abs(frame - std::round(frame)) <= kSlack + rate_hz * GltfTimeRounding(time);
  });
}

/// The rate at which frames keep all that the curves say: that of evenly spaced keys with straight lines between.
double RateOf(const std::vector<Channel>& channels, double start) {
  // Exporters give joints that stand still two keys at the ends, which say nothing about the rate.
  const bool any_moves = std::ranges::any_of(channels, [](const Channel& channel) { return channel.curve.Moves(); });
  const auto counts = [&](const Channel& channel) { return !any_moves || channel.curve.Moves(); };
  const GltfCurve* densest = nullptr;
  for (const Channel& channel : channels) {
    if (!counts(channel)) continue;
    if (any_moves && channel.curve.interpolation() != GltfInterpolation::kLinear) return kDefaultRateHz;
    if (!densest || channel.curve.times().size() > densest->times().size()) densest = &channel.curve;
  }
  const std::vector<double>& times = densest->times();
  if (times.size() < 2) return kDefaultRateHz;
  const double rate = RoundedRate(static_cast<double>(times.size() - 1) / (times.back() - times.front()));
  if (rate < kLowestRateHz || rate > kHighestRateHz) return kDefaultRateHz;
  for (const Channel& channel : channels) {
    if (counts(channel) && !LiesOnGrid(channel.curve.times(), start, rate)) return kDefaultRateHz;
  }
  return rate;
}

Timing TimingOf(const std::vector<Channel>& channels) {
  double start = channels.front().curve.times().front();
  double end = start;
  for (const Channel& channel : channels) {
    start = std::min(start, channel.curve.times().front());
    end = std::max(end, channel.curve.times().back());
  }
  const double rate = RateOf(channels, start);
  constexpr double kSlack = 0.02;  // of a frame, as above
  return {start, rate, std::floor((end - start) * rate + kSlack) + 1};
}

class ClipReader {
 public:
  ClipReader(GltfFile& file, const GltfNodes& nodes) : file_(file), nodes_(nodes) {}

  Result<std::vector<Clip>> Read() {
    const std::size_t count = file_.model().animations.size();
    if (count > kMostAnimations) {
      return file_.Refuse("animations", "found {}; allowed: {}", count, kMostAnimations);
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
    for (std::size_t i = 0; i < animation.channels.size(); ++i) {
      const tinygltf::AnimationChannel& source = animation.channels[i];
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
        continue;  // of morph targets, which are not read
      } else {
        return file_.Refuse(where + ".target.path", "found {}; allowed: translation, rotation, scale, weights",
                            Quote(source.target_path));
      }
      const int joint = nodes_.joint_of[source.target_node];
      if (joint < 0) continue;  // a node that only holds a skinned mesh moves nothing
      const bool is_double = std::ranges::any_of(
          channels, [&](const Channel& other) { return other.joint == joint && other.property == property; });
      if (is_double) {
        return file_.Refuse(where, "found the {} of node {} again; allowed: one channel each", source.target_path,
                            source.target_node);
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
    if (frame_bytes_ > kMostFrameBytes) {
      return file_.Refuse(where, "with its {} frames of {} joints all clips take {:.0f} MB; allowed: {:.0f} MB",
                          timing.frames, joints, frame_bytes_ / 1e6, kMostFrameBytes / 1e6);
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
    clips_.push_back(std::move(clip));
    return {};
  }

  /// As in the file; unnamed ones by their place, doubled ones with a number behind.
  std::string UniqueName(int index) {
    const std::string& given = At(index).name;
    const std::string base = given.empty() ? fmt::format("animation_{}", index) : given;
    std::string name = base;
    for (int number = 2; !names_.insert(name).second; ++number) name = fmt::format("{}_{}", base, number);
    return name;
  }

  GltfFile& file_;
  const GltfNodes& nodes_;
  double frame_bytes_ = 0;
  std::set<std::string> names_;
  std::vector<Clip> clips_;
};

}  // namespace

Result<std::vector<Clip>> ReadGltfClips(GltfFile& file, const GltfNodes& nodes) {
  return ClipReader(file, nodes).Read();
}

}  // namespace etude
