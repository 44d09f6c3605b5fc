#include "engine/formats/gltf/skin.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace etude {
namespace {

using Bindings = std::vector<SkinnedMesh::Binding>;

/// The four largest weights of a vertex with their bindings; the weights have the sum 1. If the file gives the vertex
/// at most four weights, the weights keep the file's order.
struct Influences {
  std::array<int, 4> bindings{};
  std::array<double, 4> weights{1, 0, 0, 0};
};

Influences Strongest(std::vector<std::pair<int, double>> all) {
  if (all.size() > 4) {
    std::ranges::stable_sort(all, [](const auto& a, const auto& b) { return a.second > b.second; });
    all.resize(4);
  }
  double sum = 0;
  for (const auto& [binding, weight] : all) sum += weight;
  Influences influences;
  if (sum <= 0) return influences;
  // If the sum is 1 within float rounding, the weights are not changed, so that writing and reading a file keeps the
  // same weights.
  constexpr double kRounding = 1e-6;
  const double divisor = std::abs(sum - 1) < kRounding ? 1.0 : sum;
  influences.weights = {};
  for (std::size_t k = 0; k < all.size(); ++k) {
    influences.bindings[k] = all[k].first;
    influences.weights[k] = all[k].second / divisor;
  }
  return influences;
}

}  // namespace

Result<Bindings> ReadGltfBindings(GltfFile& file, const GltfNodes& nodes, int node) {
  // A node without a skin is bound to itself.
  const tinygltf::Model& model = file.model();
  const int index = model.nodes[static_cast<std::size_t>(node)].skin;
  if (index == kNoIndex) {
    SkinnedMesh::Binding rigid;
    rigid.joint = nodes.joint_of[node];
    return Bindings{rigid};
  }
  // A node with a skin is bound to the skin's joints.
  RETURN_IF_ERROR(file.CheckIndex(index, model.skins.size(), fmt::format("nodes[{}].skin", node)));
  const tinygltf::Skin& skin = model.skins[static_cast<std::size_t>(index)];
  const std::string name = fmt::format("skins[{}]", index);
  if (skin.joints.empty()) return file.Refuse(name + ".joints", "found none; allowed: at least one");
  Bindings bindings;
  for (const int joint : skin.joints) bindings.push_back({nodes.joint_of[joint]});
  // Read the inverse bind matrices, which are optional.
  if (skin.inverseBindMatrices == kNoIndex) return bindings;
  const std::string matrices_name = name + ".inverseBindMatrices";
  ASSIGN_OR_RETURN(auto matrices, file.Read(skin.inverseBindMatrices, 16, GltfComponents::kFloat, matrices_name));
  if (matrices.Count() < bindings.size()) {
    return file.Refuse(matrices_name, "found {} matrices for {} joints; allowed: one for each joint", matrices.Count(),
                       bindings.size());
  }
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    const double* m = matrices[i];
    constexpr double kRounding = 1e-3;
    const bool is_affine = std::abs(m[3]) < kRounding && std::abs(m[7]) < kRounding && std::abs(m[11]) < kRounding &&
                           std::abs(m[15] - 1) < kRounding;
    if (!is_affine) {
      return file.Refuse(fmt::format("{}[{}]", matrices_name, i),
                         "the matrix contains a projection; allowed: the last row 0, 0, 0, 1");
    }
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) bindings[i].inverse_bind[column][row] = m[4 * column + row];
    }
  }
  return bindings;
}

Result<void> ReadGltfWeights(GltfFile& file, const tinygltf::Primitive& primitive, const std::string& where,
                             SkinnedMesh& mesh) {
  // Read all sets of joints and weights.
  std::vector<GltfNumbers> joints, weights;
  for (int set = 0;; ++set) {
    const auto joint = primitive.attributes.find(fmt::format("JOINTS_{}", set));
    const auto weight = primitive.attributes.find(fmt::format("WEIGHTS_{}", set));
    const bool has_joints = joint != primitive.attributes.end();
    if (has_joints != (weight != primitive.attributes.end())) {
      return file.Refuse(where, "found only one of JOINTS_{0} and WEIGHTS_{0}; allowed: both or none", set);
    }
    if (!has_joints) break;
    ASSIGN_OR_RETURN(auto joint_numbers,
                     ReadGltfAttribute(file, joint->second, 4, GltfComponents::kUnsigned, where + ".JOINTS", mesh));
    auto weight_numbers =
        ReadGltfAttribute(file, weight->second, 4, GltfComponents::kFloatOrNormalized, where + ".WEIGHTS", mesh);
    if (!weight_numbers) return tl::unexpected(weight_numbers.error());
    joints.push_back(std::move(joint_numbers));
    weights.push_back(std::move(*weight_numbers));
  }
  if (joints.empty()) return file.Refuse(where, "found a skin, but no JOINTS_0; allowed: both or none");
  // Keep the largest four weights of every vertex.
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    std::vector<std::pair<int, double>> all;
    for (std::size_t set = 0; set < joints.size(); ++set) {
      for (std::size_t k = 0; k < 4; ++k) {
        const double joint = joints[set][i][k];
        const double weight = weights[set][i][k];
        if (weight == 0 && set > 0) continue;
        if (weight < 0) return file.Refuse(where + ".WEIGHTS", "found {}; allowed: 0 or more", weight);
        if (weight > 0 && joint >= static_cast<double>(mesh.bindings.size())) {
          return file.Refuse(where + ".JOINTS", "found joint {} at vertex {}; allowed: 0 to {}", joint, i,
                             mesh.bindings.size() - 1);
        }
        all.emplace_back(weight > 0 ? static_cast<int>(joint) : 0, weight);
      }
    }
    const Influences strongest = Strongest(std::move(all));
    mesh.vertices[i].bindings = strongest.bindings;
    mesh.vertices[i].weights = strongest.weights;
  }
  return {};
}

Result<GltfNumbers> ReadGltfAttribute(GltfFile& file, int accessor, std::size_t width, GltfComponents allowed,
                                      const std::string& where, const SkinnedMesh& mesh) {
  auto numbers = file.Read(accessor, width, allowed, where);
  if (numbers && numbers->Count() != mesh.vertices.size()) {
    return file.Refuse(where, "found {} elements; POSITION has {}", numbers->Count(), mesh.vertices.size());
  }
  return numbers;
}

}  // namespace etude
