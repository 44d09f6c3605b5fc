#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <vector>

#include "io/clips/assimp/own_keys.h"
#include "io/clips/assimp/span.h"
#include "io/clips/fbx.h"

namespace etude {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the rotation from the file's axes (right: CoordAxis, up: UpAxis, front: FrontAxis) to X, Y and Z. If the
/// three stated axes are left-handed, or two of them are the same, only the up axis counts, as in other programs.
aiMatrix4x4 TurnOf(const aiScene& scene) {
  const auto number = [&](const char* name, std::int32_t otherwise) {
    if (scene.mMetaData != nullptr) scene.mMetaData->Get(name, otherwise);
    return otherwise;
  };
  const auto axis_of = [&](const std::string& name, std::int32_t usual) {
    aiVector3D axis;
    const std::int32_t index = number((name + "Axis").c_str(), usual);
    if (index >= 0 && index <= 2) {
      axis[static_cast<unsigned>(index)] = number((name + "AxisSign").c_str(), 1) < 0 ? -1.0F : 1.0F;
    }
    return axis;
  };
  const aiVector3D right = axis_of("Coord", 0), up = axis_of("Up", 1), front = axis_of("Front", 2);
  aiMatrix4x4 turn;
  if ((right ^ up) * front > 0) {
    turn = aiMatrix4x4(right.x, right.y, right.z, 0, up.x, up.y, up.z, 0, front.x, front.y, front.z, 0, 0, 0, 0, 1);
  } else if (up.x != 0) {
    aiMatrix4x4::RotationZ(up.x * static_cast<ai_real>(std::numbers::pi / 2), turn);
  } else if (up.z != 0) {
    aiMatrix4x4::RotationX(-up.z * static_cast<ai_real>(std::numbers::pi / 2), turn);
  }
  return turn;
}

void Append(std::string& bytes, std::uint32_t number) {
  std::array<char, sizeof number> raw;
  std::memcpy(raw.data(), &number, sizeof number);
  bytes.append(raw.data(), raw.size());
}

/// Writes the nodes and animations of a scene as a GLB file. assimp's own writer is not used, because that writer
/// leaves out transforms within 0.01 of the identity: a joint one centimetre from its parent would move onto the
/// parent.
class MotionGlb {
 public:
  MotionGlb(const aiScene& scene, const FbxOwnKeys& own, FbxKeyFacts& facts) : own_(own), facts_(facts) {
    AddNode(*scene.mRootNode);
    for (unsigned i = 0; i < scene.mNumAnimations; ++i) {
      TakeOutInserted(*scene.mAnimations[i], own);
      CutToSpan(*scene.mAnimations[i], facts_);
      AddAnimation(*scene.mAnimations[i]);
    }
  }

  std::string Bytes() {
    Json document = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}, {"nodes", nodes_}};
    if (!limbs_.empty()) document["skins"] = {{{"joints", limbs_}}};
    if (!animations_.empty()) {
      document["animations"] = animations_;
      document["accessors"] = accessors_;
      document["bufferViews"] = views_;
      document["buffers"] = {{{"byteLength", numbers_.size()}}};
    }
    std::string json = document.dump(-1, ' ', false, Json::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string bytes = "glTF";
    constexpr std::uint32_t kVersion = 2, kJson = 0x4E4F534A, kBinary = 0x004E4942, kHeads = 12 + 8, kHead = 8;
    // The file is a header, the JSON chunk and the binary chunk; a file without animation has no binary chunk.
    const std::size_t binary = numbers_.empty() ? 0 : kHead + numbers_.size();
    for (const std::size_t number :
         {std::size_t{kVersion}, kHeads + json.size() + binary, json.size(), std::size_t{kJson}}) {
      Append(bytes, static_cast<std::uint32_t>(number));
    }
    bytes += json;
    if (binary == 0) return bytes;
    Append(bytes, static_cast<std::uint32_t>(numbers_.size()));
    Append(bytes, kBinary);
    return bytes + numbers_;
  }

 private:
  static constexpr const char* kGeometric = "Geometric";

  static bool IsPart(const aiNode& node, const char* kind = "") {
    return std::strstr(node.mName.C_Str(), (std::string("_$AssimpFbx$_") + kind).c_str()) != nullptr;
  }

  /// Adds a node and its subtree. assimp splits a joint with pivots into a chain of nodes; here, each chain becomes one
  /// node. A geometric transform moves the joint's mesh and nothing else, so its parts are left out; the parts that
  /// undo it for the joint's children lie below the joint.
  std::size_t AddNode(const aiNode& first) {
    const std::size_t index = nodes_.size();
    std::vector<const aiNode*> parts = {&first};
    while (IsPart(*parts.back()) && parts.back()->mNumChildren == 1) parts.push_back(parts.back()->mChildren[0]);
    const aiNode& node = *parts.back();
    const aiNode* last = &node;
    while (last->mNumChildren == 1 && IsPart(*last->mChildren[0], kGeometric)) last = last->mChildren[0];
    std::erase_if(parts, [](const aiNode* part) { return IsPart(*part, kGeometric); });
    aiMatrix4x4 whole;
    for (const aiNode* part : parts) {
      by_name_.emplace(part->mName.C_Str(), index);
      whole *= part->mTransformation;
    }
    if (parts.size() > 1) parts_[index] = std::move(parts);
    aiVector3D scale, place;
    aiQuaternion turn;
    whole.Decompose(scale, turn, place);
    nodes_.push_back({{"name", node.mName.C_Str()},
                      {"translation", {place.x, place.y, place.z}},
                      {"rotation", {turn.x, turn.y, turn.z, turn.w}},
                      {"scale", {scale.x, scale.y, scale.z}}});
    if (own_.limbs.contains(node.mName.C_Str())) limbs_.push_back(index);
    std::vector<std::size_t> children;
    for (unsigned i = 0; i < last->mNumChildren; ++i) children.push_back(AddNode(*last->mChildren[i]));
    if (!children.empty()) nodes_[index]["children"] = children;
    return index;
  }

  static aiMatrix4x4 MatrixAt(const aiNodeAnim& moved, double time) {
    const auto mix = [](const auto& a, const auto& b, ai_real share) { return Mixed(a, b, share); };
    const auto place = ValueAt(moved.mPositionKeys, moved.mNumPositionKeys, time, mix);
    const auto turn = ValueAt(moved.mRotationKeys, moved.mNumRotationKeys, time, mix);
    return {ValueAt(moved.mScalingKeys, moved.mNumScalingKeys, time, mix), turn, place};
  }

  /// The keys of a joint that assimp splits into parts: one joined key for each time at which any part has a key.
  struct JoinedKeys {
    std::vector<aiVectorKey> places, scales;
    std::vector<aiQuatKey> turns;
  };
  static JoinedKeys Join(const std::vector<const aiNode*>& parts, const aiAnimation& animation) {
    std::map<const aiNode*, const aiNodeAnim*> moved_parts;
    std::set<double> times;
    for (unsigned i = 0; i < animation.mNumChannels; ++i) {
      const aiNodeAnim& moved = *animation.mChannels[i];
      const auto part = std::ranges::find(parts, moved.mNodeName, [](const aiNode* one) { return one->mName; });
      const bool has_all = moved.mNumPositionKeys > 0 && moved.mNumRotationKeys > 0 && moved.mNumScalingKeys > 0;
      if (part == parts.end() || !has_all) continue;
      moved_parts[*part] = &moved;
      // assimp adds constant tracks with a single key, whose time has no meaning.
      const auto see = [&](const auto* keys, unsigned count) {
        for (unsigned k = 0; count > 1 && k < count; ++k) times.insert(keys[k].mTime);
      };
      see(moved.mPositionKeys, moved.mNumPositionKeys);
      see(moved.mRotationKeys, moved.mNumRotationKeys);
      see(moved.mScalingKeys, moved.mNumScalingKeys);
    }
    if (times.empty() && !moved_parts.empty()) times.insert(0);
    // If only the joint's own node has keys, these keys hold the whole transform, because assimp up to version 5.4.3
    // includes the joint's pre-rotation and post-rotation in the keys: R_pre R R_post, where FBX means R_pre R
    // R_post⁻¹. The part of the post-rotation is R_post⁻¹ in all versions; later versions give each part its own keys.
    const bool is_whole = moved_parts.size() == 1 && moved_parts.begin()->first == parts.back();
    aiQuaternion undo;
    for (const aiNode* part : parts) {
      if (!is_whole || !IsPart(*part, "PostRotation")) continue;
      const aiQuaternion inverse{aiMatrix3x3(part->mTransformation)};
      undo = inverse * inverse;
    }
    JoinedKeys joined;
    for (const double time : times) {
      aiMatrix4x4 whole;
      for (const aiNode* part : is_whole ? std::vector{parts.back()} : parts) {
        const auto moved = moved_parts.find(part);
        whole *= moved == moved_parts.end() ? part->mTransformation : MatrixAt(*moved->second, time);
      }
      aiVector3D scale, place;
      aiQuaternion turn;
      whole.Decompose(scale, turn, place);
      joined.places.emplace_back(time, place);
      joined.turns.emplace_back(time, turn * undo);
      joined.scales.emplace_back(time, scale);
    }
    return joined;
  }

  void AddAnimation(const aiAnimation& animation) {
    Json samplers = Json::array(), channels = Json::array();
    // Adds one channel: the keys of a node's translation, rotation or scale.
    const auto add = [&](std::size_t node, const char* path, const auto* keys, unsigned count, auto numbers_of) {
      std::vector<float> times, values;
      for (unsigned i = 0; i < count; ++i) {
        times.push_back(static_cast<float>(keys[i].mTime));
        for (const float number : numbers_of(keys[i].mValue)) values.push_back(number);
      }
      if (count == 0) return;
      // Two keys have the same value if all their numbers (quaternion components, metres, scale factors) differ by
      // less than this constant.
      constexpr float kSame = 0.01f;
      const std::size_t width = values.size() / count;
      for (std::size_t i = width; i < values.size(); ++i) {
        const std::size_t key = i / width;
        if (std::abs(values[i] - values[i - width]) < kSame) continue;
        facts_.longest_s = std::max(facts_.longest_s, static_cast<double>(times[key]) - times[key - 1]);
      }
      channels.push_back({{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
      samplers.push_back({{"input", AddNumbers(times, count)}, {"output", AddNumbers(values, count)}});
    };
    const auto vector = [](const aiVector3D& v) { return std::array{v.x, v.y, v.z}; };
    const auto turn = [](const aiQuaternion& q) { return std::array{q.x, q.y, q.z, q.w}; };
    // Add one channel for each animated property of a node. Leave out nodes that are not in the scene.
    std::set<std::size_t> joined;
    for (unsigned i = 0; i < animation.mNumChannels; ++i) {
      const aiNodeAnim& moved = *animation.mChannels[i];
      const auto node = by_name_.find(moved.mNodeName.C_Str());
      if (node == by_name_.end()) continue;
      if (const auto parts = parts_.find(node->second); parts != parts_.end()) {
        if (!joined.insert(node->second).second) continue;
        const JoinedKeys keys = Join(parts->second, animation);
        const auto count = static_cast<unsigned>(keys.places.size());
        add(node->second, "translation", keys.places.data(), count, vector);
        add(node->second, "rotation", keys.turns.data(), count, turn);
        add(node->second, "scale", keys.scales.data(), count, vector);
        continue;
      }
      add(node->second, "translation", moved.mPositionKeys, moved.mNumPositionKeys, vector);
      add(node->second, "rotation", moved.mRotationKeys, moved.mNumRotationKeys, turn);
      add(node->second, "scale", moved.mScalingKeys, moved.mNumScalingKeys, vector);
    }
    if (channels.empty()) return;
    animations_.push_back(
        {{"name", animation.mName.C_Str()}, {"samplers", std::move(samplers)}, {"channels", std::move(channels)}});
  }

  /// Adds `count` scalars, or vectors of 3 or 4 numbers; returns the index of the new accessor.
  std::size_t AddNumbers(const std::vector<float>& numbers, unsigned count) {
    constexpr int kFloat = 5126;
    const std::size_t width = numbers.size() / count, bytes = numbers.size() * sizeof(float);
    Json accessor = {{"bufferView", views_.size()}, {"componentType", kFloat}, {"count", count}};
    accessor["type"] = width == 1 ? "SCALAR" : width == 3 ? "VEC3" : "VEC4";
    if (width == 1) accessor.update({{"min", {numbers.front()}}, {"max", {numbers.back()}}});
    views_.push_back({{"buffer", 0}, {"byteOffset", numbers_.size()}, {"byteLength", bytes}});
    accessors_.push_back(std::move(accessor));
    numbers_.append(reinterpret_cast<const char*>(numbers.data()), bytes);
    return accessors_.size() - 1;
  }

  Json nodes_ = Json::array(), animations_ = Json::array(), accessors_ = Json::array(), views_ = Json::array();
  std::map<std::string, std::size_t> by_name_;  ///< for each name, the first node with this name
  std::map<std::size_t, std::vector<const aiNode*>> parts_;  ///< for each joined node, its chain in the file
  std::vector<std::size_t> limbs_;                           ///< the joints of a skeleton (LimbNode)
  std::string numbers_;
  const FbxOwnKeys& own_;
  FbxKeyFacts& facts_;
};

bool GlbOfFbxByAssimp(std::string_view bytes, std::string& said, FbxKeyFacts& facts) {
  try {
    Assimp::Importer importer;
    // If pivots are not preserved, assimp drops the keys of joints that have pivots.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
    const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_GlobalScale, "fbx");
    if (scene == nullptr || scene->mRootNode == nullptr) {
      said = std::string("the FBX file is damaged: ") + importer.GetErrorString();
      return false;
    }
    scene->mRootNode->mTransformation = TurnOf(*scene) * scene->mRootNode->mTransformation;
    const FbxOwnKeys own = ReadOwnKeys(bytes, facts);
    said = MotionGlb(*scene, own, facts).Bytes();
    return true;
  } catch (const std::exception& error) {
    said = std::string("the FBX file cannot be read: ") + error.what();
    return false;
  }
}

}  // namespace
}  // namespace etude

extern "C" __attribute__((visibility("default"))) etude::GlbOfFbxBytes* const etude_clips_assimp =
    &etude::GlbOfFbxByAssimp;
