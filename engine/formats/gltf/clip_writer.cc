#include "engine/formats/gltf/clip_writer.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "engine/formats/gltf/buffer.h"
#include "engine/formats/gltf/text.h"

namespace etude {
namespace {

/// What one property of a joint does in a clip.
struct Track {
  int joint = 0;
  const char* path = "";
  std::ptrdiff_t width = 3;
  std::vector<float> values;  ///< at rest, then frame by frame

  void Add(const glm::vec3& value) { values.insert(values.end(), {value.x, value.y, value.z}); }
  void Add(const glm::vec4& value) { values.insert(values.end(), {value.x, value.y, value.z, value.w}); }

  /// Whether all frames are alike, and so worth one key.
  bool IsStill() const { return std::equal(values.begin() + 2 * width, values.end(), values.begin() + width); }
  bool IsAtRest() const { return std::equal(values.begin() + width, values.end(), values.begin()); }
};

int AddTimes(tinygltf::Model& model, std::size_t count, double rate_hz) {
  GltfBytes bytes;
  std::vector<double> seconds;
  for (std::size_t k = 0; k < count; ++k) {
    seconds.push_back(static_cast<double>(k) / rate_hz);
    bytes.Float(seconds.back());
  }
  const int view = AddGltfView(model, bytes, 0, GltfTarget::kOther);
  return AddGltfAccessor(model, {view, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, count}, seconds);
}

std::array<Track, 3> TracksOf(const Skeleton& skeleton, const Clip& clip, std::size_t joint) {
  const int index = static_cast<int>(joint);
  std::array<Track, 3> tracks = {Track{index, "translation", 3, {}}, Track{index, "rotation", 4, {}},
                                 Track{index, "scale", 3, {}}};
  const auto add = [&](const LocalTransform& local) {
    const glm::dquat& q = local.rotation;
    tracks[0].Add(glm::vec3(local.translation));
    tracks[1].Add(glm::vec4(glm::dvec4(q.x, q.y, q.z, q.w)));
    tracks[2].Add(glm::vec3(local.scale));
  };
  add(skeleton.joints[joint].rest);
  for (const LocalPose& pose : clip.frames) add(pose[joint]);
  return tracks;
}

/// With one key or a key per frame, as many as `input` has.
void AddTrack(tinygltf::Model& model, tinygltf::Animation& animation, const Track& track, int input) {
  const std::size_t count = model.accessors[static_cast<std::size_t>(input)].count;
  const auto width = static_cast<std::size_t>(track.width);
  GltfBytes bytes;
  for (std::size_t i = width; i < (count + 1) * width; ++i) bytes.Float(track.values[i]);
  const int view = AddGltfView(model, bytes, 0, GltfTarget::kOther);
  tinygltf::AnimationSampler sampler;
  sampler.input = input;
  sampler.output = AddGltfAccessor(
      model, {view, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, width == 4 ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3, count});
  tinygltf::AnimationChannel channel;
  channel.sampler = static_cast<int>(animation.samplers.size());
  channel.target_node = track.joint;
  channel.target_path = track.path;
  animation.samplers.push_back(std::move(sampler));
  animation.channels.push_back(std::move(channel));
}

}  // namespace

void AddGltfClip(tinygltf::Model& model, const Skeleton& skeleton, const Clip& clip) {
  if (clip.frames.empty()) return;
  std::vector<Track> tracks;
  for (std::size_t joint = 0; joint < skeleton.joints.size(); ++joint) {
    for (Track& track : TracksOf(skeleton, clip, joint)) tracks.push_back(std::move(track));
  }
  // An animation needs a channel, and one of full length, also when nothing moves.
  const bool all_still = std::ranges::all_of(tracks, &Track::IsStill);
  const int times = AddTimes(model, clip.frames.size(), clip.rate_hz);
  int first_time = -1;  // made when asked for

  tinygltf::Animation animation;
  animation.name = GltfText(clip.name);
  for (const Track& track : tracks) {
    const bool is_kept = all_still && &track == &tracks.front();
    if (!is_kept && track.IsAtRest()) continue;
    const bool needs_one_key = !is_kept && track.IsStill();
    if (needs_one_key && first_time < 0) first_time = AddTimes(model, 1, clip.rate_hz);
    AddTrack(model, animation, track, needs_one_key ? first_time : times);
  }
  model.animations.push_back(std::move(animation));
}

}  // namespace etude
