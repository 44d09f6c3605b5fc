#include "engine/formats/gltf/nodes.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

#include "engine/base/names.h"
#include "engine/formats/unique_names.h"

namespace etude {
namespace {

constexpr std::size_t kMaxJoints = 1024;
constexpr int kMaxLevels = 128;

/// Tolerance for a matrix that was rounded to floats: its axes must be perpendicular, and its last row must be 0, 0, 0,
/// 1.
constexpr double kMatrixRounding = 1e-3;

std::string NodeName(int node) { return fmt::format("nodes[{}]", node); }

class NodeReader {
 public:
  explicit NodeReader(const GltfFile& file) : file_(file), model_(file.model()), count_(model_.nodes.size()) {}

  Result<GltfNodes> Read() {
    if (count_ == 0) return file_.Refuse("nodes", "found none; allowed: at least one");
    for (auto step : {&NodeReader::FindParents, &NodeReader::CheckNesting, &NodeReader::MarkScene,
                      &NodeReader::MarkOutsiders, &NodeReader::MakeJoints}) {
      RETURN_IF_ERROR((this->*step)());
    }
    return std::move(nodes_);
  }

 private:
  const tinygltf::Node& At(int node) const { return model_.nodes[static_cast<std::size_t>(node)]; }

  Result<void> FindParents() {
    parents_.assign(count_, kNoIndex);
    for (int node = 0; node < static_cast<int>(count_); ++node) {
      const std::vector<int>& children = At(node).children;
      for (std::size_t i = 0; i < children.size(); ++i) {
        const std::string where = fmt::format("{}.children[{}]", NodeName(node), i);
        RETURN_IF_ERROR(file_.CheckIndex(children[i], count_, where));
        int& parent = parents_[children[i]];
        if (parent != kNoIndex) {
          return file_.Refuse(where, "found node {}, which is already a child of node {}; allowed: one parent",
                              children[i], parent);
        }
        parent = node;
      }
    }
    return {};
  }

  Result<void> CheckNesting() {
    for (int node = 0; node < static_cast<int>(count_); ++node) {
      int depth = 1;
      for (int above = parents_[node]; above != kNoIndex; above = parents_[above]) {
        if (above == node)
          return file_.Refuse(NodeName(node), "the node is its own ancestor; allowed: a tree of nodes");
        if (++depth > kMaxLevels) return TooDeep(node);
      }
    }
    return {};
  }

  /// Returns the error for a node that is nested too deep or lies below a cycle: a path longer than the number of nodes
  /// contains a cycle.
  Result<void> TooDeep(int node) const {
    std::size_t steps = 0;
    for (int above = parents_[node]; above != kNoIndex; above = parents_[above]) {
      if (++steps > count_)
        return file_.Refuse(NodeName(node), "an ancestor of the node is its own ancestor; allowed: a tree of nodes");
    }
    return file_.Refuse(NodeName(node), "nested more than {} levels deep", kMaxLevels);
  }

  Result<void> MarkScene() {
    // Find the roots of the scene, or of all nodes if there is no scene.
    is_joint_.assign(count_, false);
    in_scene_.assign(count_, false);
    std::vector<int> open;
    if (model_.scenes.empty()) {
      for (int node = 0; node < static_cast<int>(count_); ++node) {
        if (parents_[node] == kNoIndex) open.push_back(node);
      }
    } else {
      const int scene = model_.defaultScene < 0 ? 0 : model_.defaultScene;
      RETURN_IF_ERROR(file_.CheckIndex(scene, model_.scenes.size(), "scene"));
      open = model_.scenes[static_cast<std::size_t>(scene)].nodes;
      for (std::size_t i = 0; i < open.size(); ++i) {
        const std::string where = fmt::format("scenes[{}].nodes[{}]", scene, i);
        RETURN_IF_ERROR(file_.CheckIndex(open[i], count_, where));
        if (parents_[open[i]] != kNoIndex) {
          return file_.Refuse(where, "found node {}, which is a child of node {}; allowed: nodes without a parent",
                              open[i], parents_[open[i]]);
        }
      }
    }
    // Mark all nodes below the roots.
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      if (in_scene_[node]) continue;  // a root may be listed twice
      in_scene_[node] = true;
      is_joint_[node] = true;
      open.insert(open.end(), At(node).children.begin(), At(node).children.end());
    }
    return {};
  }

  Result<void> MarkOutsiders() {
    // Mark bones of skins and animated nodes, with their ancestors.
    std::vector<bool> is_bone(count_, false);
    for (std::size_t i = 0; i < model_.skins.size(); ++i) {
      const std::vector<int>& joints = model_.skins[i].joints;
      for (std::size_t k = 0; k < joints.size(); ++k) {
        const std::string where = fmt::format("skins[{}].joints[{}]", i, k);
        RETURN_IF_ERROR(file_.CheckIndex(joints[k], count_, where));
        is_bone[joints[k]] = true;
        MarkWithAncestors(joints[k]);
      }
    }
    for (std::size_t i = 0; i < model_.animations.size(); ++i) {
      for (std::size_t k = 0; k < model_.animations[i].channels.size(); ++k) {
        const tinygltf::AnimationChannel& channel = model_.animations[i].channels[k];
        const int target = channel.target_node;
        // Ignore a target without a node: tinygltf 2.7 leaves the target's channel out, 2.9 keeps the channel.
        if (target == kNoIndex && !channel.target_path.empty()) continue;
        const std::string where = fmt::format("animations[{}].channels[{}].target.node", i, k);
        RETURN_IF_ERROR(file_.CheckIndex(target, count_, where));
        MarkWithAncestors(target);
      }
    }
    // Collect the nodes with meshes; a leaf that holds only a skinned mesh is not a joint.
    for (int node = 0; node < static_cast<int>(count_); ++node) {
      if (!in_scene_[node] || At(node).mesh == kNoIndex) continue;
      nodes_.mesh_nodes.push_back(node);
      if (At(node).skin != kNoIndex && At(node).children.empty() && !is_bone[node]) is_joint_[node] = false;
    }
    return {};
  }

  void MarkWithAncestors(int node) {
    for (; node != kNoIndex && !is_joint_[node]; node = parents_[node]) is_joint_[node] = true;
  }

  Result<void> MakeJoints() {
    const auto joints = static_cast<std::size_t>(std::ranges::count(is_joint_, true));
    if (joints == 0) return file_.Refuse("scenes", "the default scene has no nodes; allowed: at least one");
    if (joints > kMaxJoints) return file_.Refuse("nodes", "found {} joints; allowed: at most {}", joints, kMaxJoints);
    nodes_.joint_of.assign(count_, kNoIndex);
    for (int node = 0; node < static_cast<int>(count_); ++node) {
      if (!is_joint_[node]) continue;
      // If the file lists a node's ancestors after the node, make the joints of the ancestors first, from the root
      // down.
      std::vector<int> chain;
      for (int above = node; above != kNoIndex && nodes_.joint_of[above] == kNoIndex; above = parents_[above]) {
        chain.push_back(above);
      }
      std::ranges::reverse(chain);
      for (const int next : chain) RETURN_IF_ERROR(MakeJoint(next));
    }
    return CheckGltfPose(file_, nodes_.skeleton, RestPose(nodes_.skeleton), "nodes");
  }

  Result<void> MakeJoint(int node) {
    ASSIGN_OR_RETURN(auto rest, ReadTransform(node));
    const std::string& name = At(node).name;
    const int parent = parents_[node] == kNoIndex ? kNoIndex : nodes_.joint_of[parents_[node]];
    nodes_.joint_of[node] = static_cast<int>(nodes_.skeleton.joints.size());
    nodes_.skeleton.joints.push_back(
        {.name = names_.Add(name.empty() ? fmt::format("node_{}", node) : name), .parent = parent, .rest = rest});
    return {};
  }

  Result<void> CheckNumbers(const std::vector<double>& numbers, std::size_t count, const std::string& where) const {
    if (!numbers.empty() && numbers.size() != count) {
      return file_.Refuse(where, "found {} numbers; allowed: {}", numbers.size(), count);
    }
    for (const double number : numbers) {
      if (!(std::abs(number) <= kMaxGltfNumber)) {
        return file_.Refuse(where, "found {}; allowed: numbers within ±{:g}", number, kMaxGltfNumber);
      }
    }
    return {};
  }

  Result<LocalTransform> ReadTransform(int index) const {
    const tinygltf::Node& node = At(index);
    const std::string where = NodeName(index);
    for (const auto& [numbers, count, name] :
         {std::tuple(&node.matrix, 16, ".matrix"), std::tuple(&node.translation, 3, ".translation"),
          std::tuple(&node.rotation, 4, ".rotation"), std::tuple(&node.scale, 3, ".scale")}) {
      RETURN_IF_ERROR(CheckNumbers(*numbers, static_cast<std::size_t>(count), where + name));
    }
    if (!node.matrix.empty()) return Decompose(node.matrix, where + ".matrix");
    LocalTransform local;
    if (const auto& t = node.translation; !t.empty()) local.translation = {t[0], t[1], t[2]};
    if (const auto& s = node.scale; !s.empty()) local.scale = {s[0], s[1], s[2]};
    if (const auto& r = node.rotation; !r.empty()) {
      if (std::ranges::all_of(r, [](double number) { return std::abs(number) < 1e-9; })) {
        return file_.Refuse(where + ".rotation", "found a quaternion of length 0; allowed: unit quaternions");
      }
      local.rotation = RotationFrom(r.data());
    }
    return local;
  }

  Result<LocalTransform> Decompose(const std::vector<double>& m, const std::string& where) const {
    const bool is_affine = std::abs(m[3]) < kMatrixRounding && std::abs(m[7]) < kMatrixRounding &&
                           std::abs(m[11]) < kMatrixRounding && std::abs(m[15] - 1) < kMatrixRounding;
    if (!is_affine) return file_.Refuse(where, "the matrix contains a projection; allowed: the last row 0, 0, 0, 1");
    LocalTransform local;
    local.translation = {m[12], m[13], m[14]};
    glm::dmat3 axes(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]);
    for (int k = 0; k < 3; ++k) {
      local.scale[k] = glm::length(axes[k]);
      if (local.scale[k] < 1e-9)
        return file_.Refuse(where,
                            "the matrix scales an axis to 0; allowed: a product of translation, rotation and scale");
      axes[k] /= local.scale[k];
    }
    if (glm::determinant(axes) < 0) {  // a mirror image: give the negative sign to the scale of x
      local.scale.x = -local.scale.x;
      axes[0] = -axes[0];
    }
    const double shear = std::max({std::abs(glm::dot(axes[0], axes[1])), std::abs(glm::dot(axes[1], axes[2])),
                                   std::abs(glm::dot(axes[2], axes[0]))});
    if (shear > kMatrixRounding)
      return file_.Refuse(where, "the matrix contains a shear; allowed: a product of translation, rotation and scale");
    local.rotation = glm::normalize(glm::quat_cast(axes));
    return local;
  }

  const GltfFile& file_;
  const tinygltf::Model& model_;
  const std::size_t count_;
  std::vector<int> parents_;
  std::vector<bool> in_scene_;
  std::vector<bool> is_joint_;
  UniqueNames names_;
  GltfNodes nodes_;
};

}  // namespace

Result<GltfNodes> ReadGltfNodes(const GltfFile& file) { return NodeReader(file).Read(); }

Result<void> CheckGltfPose(const GltfFile& file, const Skeleton& skeleton, const LocalPose& pose,
                           const std::string& where) {
  const auto is_within = [](const glm::dvec3& v) {
    return std::abs(v.x) <= kMaxGltfNumber && std::abs(v.y) <= kMaxGltfNumber &&
           std::abs(v.z) <= kMaxGltfNumber;
  };
  std::vector<GlobalTransform> globals;
  ComputeGlobals(skeleton, pose, globals);
  for (std::size_t i = 0; i < globals.size(); ++i) {
    const auto& [position, axes] = globals[i];
    if (is_within(position) && is_within(axes[0]) && is_within(axes[1]) && is_within(axes[2])) continue;
    return file.Refuse(where, "a world coordinate of joint {} is out of range; allowed: ±{:g}",
                       Quote(skeleton.joints[i].name), kMaxGltfNumber);
  }
  return {};
}

bool IsUnit(double square_length) {
  constexpr double kFloatRounding = 3e-7;
  return std::abs(square_length - 1) < kFloatRounding;
}

glm::dquat RotationFrom(const double* xyzw) {
  const glm::dquat rotation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  return IsUnit(glm::dot(rotation, rotation)) ? rotation : glm::normalize(rotation);
}

}  // namespace etude
