#include <tiny_gltf.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "engine/formats/gltf/buffer.h"
#include "engine/formats/gltf/clip_writer.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/gltf/mesh.h"
#include "engine/formats/gltf/text.h"

namespace etude {
namespace {

/// Meshes that are written as the primitives of one: neighbours of one name on the same joints.
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
    material.pbrMetallicRoughness.metallicFactor = 0;  // the format's default is bare metal
    model_.materials.push_back(std::move(material));
  }

  /// A rigid surface hangs on its joint's node; any other gets a node of its own beside a skin.
  void AddGroup(Group group) {
    const SkinnedMesh& first = group.front();
    const bool is_rigid = first.bindings.size() == 1 && first.bindings[0].inverse_bind == glm::dmat4(1) &&
                          model_.nodes[static_cast<std::size_t>(first.bindings[0].joint)].mesh < 0;
    tinygltf::Mesh mesh;
    mesh.name = GltfText(first.name);
    for (const SkinnedMesh& part : group) {
      if (is_rigid && IsMirrored(character_.skeleton, first.bindings[0].joint)) {
        SkinnedMesh turned = part;  // as it will be on reading
        TurnOver(turned);
        mesh.primitives.push_back(MakePrimitive(turned, false));
      } else {
        mesh.primitives.push_back(MakePrimitive(part, !is_rigid));
      }
    }
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
        // Joints of no weight are written as 0, as the specification demands.
        const auto binding = static_cast<std::uint32_t>(vertex.weights[k] != 0 ? vertex.bindings[k] : 0);
        if (short_joints) {
          bytes.Short(binding);
        } else {
          bytes.Byte(binding);
        }
      }
    }
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
    const bool is_short = mesh.vertices.size() <= 65535;  // 65535 itself means a restart
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

  /// The skin of these bindings, made where there is none yet.
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
  std::vector<const SkinnedMesh*> skinned_;  ///< per skin, a mesh that it was made for
};

}  // namespace

std::string WriteGlb(const Character& character, std::span<const Clip> clips) {
  return GlbWriter(character).Write(clips);
}

}  // namespace etude
