#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include "engine/formats/gltf/file.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/gltf/mesh.h"
#include "engine/motion/clip.h"

namespace etude {
namespace {

/// The bytes of a buffer view under construction.
class GltfBytes {
 public:
  void Float(double value);  ///< adds the value, rounded to a float
  void Byte(std::uint32_t value);
  void Short(std::uint32_t value);
  void Integer(std::uint32_t value);

  std::size_t size() const { return bytes_.size(); }
  const std::vector<unsigned char>& bytes() const { return bytes_; }

 private:
  template <typename T>
  void Append(T value);

  std::vector<unsigned char> bytes_;
};

/// The kind of content of a buffer view, which the view's property `target` states.
enum class GltfTarget { kOther, kVertices, kIndices };

/// The elements of an accessor: their location and type.
struct GltfSlice {
  int view = 0;
  std::size_t offset = 0;
  int component_type = 0;  ///< TINYGLTF_COMPONENT_TYPE_…
  int type = 0;            ///< TINYGLTF_TYPE_…
  std::size_t count = 0;
};

static_assert(std::endian::native == std::endian::little, "the format's bytes are little-endian");

template <typename T>
void GltfBytes::Append(T value) {
  const std::size_t at = bytes_.size();
  bytes_.resize(at + sizeof value);
  std::memcpy(bytes_.data() + at, &value, sizeof value);
}

void GltfBytes::Float(double value) { Append(static_cast<float>(value)); }

void GltfBytes::Byte(std::uint32_t value) { Append(static_cast<std::uint8_t>(value)); }

void GltfBytes::Short(std::uint32_t value) { Append(static_cast<std::uint16_t>(value)); }

void GltfBytes::Integer(std::uint32_t value) { Append(value); }

/// Appends bytes to the model's only buffer as a new view, aligned to 4 bytes, and returns the view's index. With
/// `stride` 0 the elements are contiguous.
int AddGltfView(tinygltf::Model& model, const GltfBytes& bytes, std::size_t stride, GltfTarget target) {
  if (model.buffers.empty()) model.buffers.emplace_back();
  std::vector<unsigned char>& data = model.buffers.front().data;
  data.resize((data.size() + 3) / 4 * 4);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = bytes.size();
  view.byteStride = stride;
  if (target == GltfTarget::kVertices) view.target = TINYGLTF_TARGET_ARRAY_BUFFER;
  if (target == GltfTarget::kIndices) view.target = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
  data.insert(data.end(), bytes.bytes().begin(), bytes.bytes().end());
  model.bufferViews.push_back(std::move(view));
  return static_cast<int>(model.bufferViews.size()) - 1;
}

/// Adds an accessor and returns its index. If `values` holds the accessor's numbers, element by element, the minimum
/// and maximum of each component are stored, too; glTF requires them for positions and key times.
int AddGltfAccessor(tinygltf::Model& model, const GltfSlice& slice, std::span<const double> values = {}) {
  tinygltf::Accessor accessor;
  accessor.bufferView = slice.view;
  accessor.byteOffset = slice.offset;
  accessor.componentType = slice.component_type;
  accessor.type = slice.type;
  accessor.count = slice.count;
  const std::size_t width = values.size() / std::max<std::size_t>(slice.count, 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = static_cast<float>(values[i]);
    if (i < width) {
      accessor.minValues.push_back(value);
      accessor.maxValues.push_back(value);
    }
    double& least = accessor.minValues[i % width];
    double& greatest = accessor.maxValues[i % width];
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

/// One property of a joint over the frames of a clip.
struct Track {
  int joint = 0;
  const char* path = "";
  std::ptrdiff_t width = 3;
  std::vector<float> values;  ///< the value at rest, then the value of every frame

  void Add(const glm::vec3& value) { values.insert(values.end(), {value.x, value.y, value.z}); }
  void Add(const glm::vec4& value) { values.insert(values.end(), {value.x, value.y, value.z, value.w}); }

  /// Returns true if the value is the same in all frames, so that one key is enough.
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

/// Adds a channel whose keys are at the times in accessor `input`: one key, or one per frame.
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

/// Adds a clip as a LINEAR animation of the model's first nodes, which are the joints of `skeleton`. A property that
/// has its rest value in all frames gets no channel; any other constant property gets one key. If nothing moves, one
/// channel gets all keys, so that the clip keeps its length. A clip without frames is left out.
void AddGltfClip(tinygltf::Model& model, const Skeleton& skeleton, const Clip& clip) {
  if (clip.frames.empty()) return;
  std::vector<Track> tracks;
  for (std::size_t joint = 0; joint < skeleton.joints.size(); ++joint) {
    for (Track& track : TracksOf(skeleton, clip, joint)) tracks.push_back(std::move(track));
  }
  // An animation needs at least one channel, even if nothing moves.
  const bool all_still = std::ranges::all_of(tracks, &Track::IsStill);
  const int times = AddTimes(model, clip.frames.size(), clip.rate_hz);
  int first_time = -1;  // accessor with one time for constant properties; created on first use

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

/// Neighbouring meshes with the same name and joints: the primitives of one written mesh.
using Group = std::span<const SkinnedMesh>;

bool SameBindings(const SkinnedMesh& a, const SkinnedMesh& b) {
  return std::ranges::equal(a.bindings, b.bindings, [](const auto& x, const auto& y) {
    return x.joint == y.joint && x.inverse_bind == y.inverse_bind;
  });
}

class GlbWriter {
 public:
  explicit GlbWriter(const Character& character) : character_(character) {}

  std::string Write(std::span<const Clip> clips) {
    model_.asset.version = "2.0";
    model_.asset.generator = "Etude";
    AddNodes();
    for (const Material& material : character_.materials) AddMaterial(material);
    const std::vector<SkinnedMesh>& meshes = character_.meshes;
    for (std::size_t first = 0, end = 0; first < meshes.size(); first = end) {
      for (end = first + 1; end < meshes.size(); ++end) {
        if (meshes[end].name != meshes[first].name || !SameBindings(meshes[end], meshes[first])) break;
      }
      AddGroup(Group(meshes).subspan(first, end - first));
    }
    for (const Clip& clip : clips) AddGltfClip(model_, character_.skeleton, clip);
    std::ostringstream stream;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, stream, /*prettyPrint=*/false, /*writeBinary=*/true);
    return std::move(stream).str();
  }

 private:
  void AddNodes() {
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
    const std::vector<Joint>& joints = character_.skeleton.joints;
    model_.nodes.resize(joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const auto& [translation, rotation, scale] = joints[i].rest;
      tinygltf::Node& node = model_.nodes[i];
      node.name = GltfText(joints[i].name);
      if (translation != glm::dvec3(0)) node.translation = {translation.x, translation.y, translation.z};
      if (rotation != glm::dquat(1, 0, 0, 0)) node.rotation = {rotation.x, rotation.y, rotation.z, rotation.w};
      if (scale != glm::dvec3(1)) node.scale = {scale.x, scale.y, scale.z};
      std::vector<int>& siblings = joints[i].parent < 0
                                       ? model_.scenes.front().nodes
                                       : model_.nodes[static_cast<std::size_t>(joints[i].parent)].children;
      siblings.push_back(static_cast<int>(i));
    }
  }

  void AddMaterial(const Material& source) {
    tinygltf::Material material;
    material.name = GltfText(source.name);
    const glm::dvec3& colour = source.colour;
    material.pbrMetallicRoughness.baseColorFactor = {colour.r, colour.g, colour.b, 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0;  // the format's default is metal
    model_.materials.push_back(std::move(material));
  }

  /// Adds a mesh. A rigid mesh is attached to the node of its joint; any other mesh gets a node of its own with a skin.
  void AddGroup(Group group) {
    // Write the primitives.
    const SkinnedMesh& first = group.front();
    const bool is_rigid = first.bindings.size() == 1 && first.bindings[0].inverse_bind == glm::dmat4(1) &&
                          model_.nodes[static_cast<std::size_t>(first.bindings[0].joint)].mesh < 0;
    tinygltf::Mesh mesh;
    mesh.name = GltfText(first.name);
    for (const SkinnedMesh& part : group) {
      if (is_rigid && IsMirrored(character_.skeleton, first.bindings[0].joint)) {
        SkinnedMesh turned = part;  // flipped, because the reader flips the triangles of a mirrored joint
        FlipTriangles(turned);
        mesh.primitives.push_back(MakePrimitive(turned, false));
      } else {
        mesh.primitives.push_back(MakePrimitive(part, !is_rigid));
      }
    }
    // Attach the mesh to a node.
    const int index = static_cast<int>(model_.meshes.size());
    model_.meshes.push_back(std::move(mesh));
    if (is_rigid) {
      model_.nodes[static_cast<std::size_t>(first.bindings[0].joint)].mesh = index;
      return;
    }
    tinygltf::Node node;
    node.name = GltfText(first.name);
    node.mesh = index;
    node.skin = SkinOf(first);
    model_.scenes.front().nodes.push_back(static_cast<int>(model_.nodes.size()));
    model_.nodes.push_back(std::move(node));
  }

  tinygltf::Primitive MakePrimitive(const SkinnedMesh& mesh, bool has_skin) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = mesh.material;

    // Interleave the vertices' attributes.
    const bool short_joints = mesh.bindings.size() > 256;
    GltfBytes bytes;
    std::vector<double> positions;
    for (const SkinnedMesh::Vertex& vertex : mesh.vertices) {
      for (int k = 0; k < 3; ++k) bytes.Float(vertex.position[k]);
      for (int k = 0; k < 3; ++k) bytes.Float(vertex.normal[k]);
      positions.insert(positions.end(), {vertex.position.x, vertex.position.y, vertex.position.z});
      if (!has_skin) continue;
      for (const double weight : vertex.weights) bytes.Float(weight);
      for (std::size_t k = 0; k < 4; ++k) {
        // The index of a joint with weight 0 is written as 0, as the specification demands.
        const auto binding = static_cast<std::uint32_t>(vertex.weights[k] != 0 ? vertex.bindings[k] : 0);
        if (short_joints) {
          bytes.Short(binding);
        } else {
          bytes.Byte(binding);
        }
      }
    }
    // Describe the attributes by accessors.
    const std::size_t count = mesh.vertices.size();
    const int view = AddGltfView(model_, bytes, bytes.size() / count, GltfTarget::kVertices);
    const auto attribute = [&](std::size_t offset, int component, int type) {
      return AddGltfAccessor(model_, {view, offset, component, type, count});
    };
    primitive.attributes["POSITION"] =
        AddGltfAccessor(model_, {view, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, count}, positions);
    primitive.attributes["NORMAL"] = attribute(12, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
    if (has_skin) {
      primitive.attributes["WEIGHTS_0"] = attribute(24, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4);
      primitive.attributes["JOINTS_0"] =
          attribute(40, short_joints ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                    TINYGLTF_TYPE_VEC4);
    }
    primitive.indices = AddIndices(mesh);
    return primitive;
  }

  int AddIndices(const SkinnedMesh& mesh) {
    const bool is_short = mesh.vertices.size() <= 65535;  // in 16 bits, index 65535 would mean a primitive restart
    GltfBytes bytes;
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) {
        if (is_short) {
          bytes.Short(corner);
        } else {
          bytes.Integer(corner);
        }
      }
    }
    const int view = AddGltfView(model_, bytes, 0, GltfTarget::kIndices);
    return AddGltfAccessor(
        model_, {view, 0, is_short ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                 TINYGLTF_TYPE_SCALAR, 3 * mesh.triangles.size()});
  }

  /// Returns the skin for these bindings, and adds it if there is none yet.
  int SkinOf(const SkinnedMesh& mesh) {
    for (std::size_t i = 0; i < skinned_.size(); ++i) {
      if (SameBindings(*skinned_[i], mesh)) return static_cast<int>(i);
    }
    tinygltf::Skin skin;
    GltfBytes bytes;
    for (const SkinnedMesh::Binding& binding : mesh.bindings) {
      skin.joints.push_back(binding.joint);
      for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) bytes.Float(binding.inverse_bind[column][row]);
      }
    }
    const int view = AddGltfView(model_, bytes, 0, GltfTarget::kOther);
    skin.inverseBindMatrices =
        AddGltfAccessor(model_, {view, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_MAT4, mesh.bindings.size()});
    model_.skins.push_back(std::move(skin));
    skinned_.push_back(&mesh);
    return static_cast<int>(model_.skins.size()) - 1;
  }

  const Character& character_;
  tinygltf::Model model_;
  std::vector<const SkinnedMesh*> skinned_;  ///< for each skin, a mesh that uses it
};

}  // namespace

std::string WriteGlb(const Character& character, std::span<const Clip> clips) {
  return GlbWriter(character).Write(clips);
}

}  // namespace etude
