#include "sim/character/posed.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/base/srgb.h"
#include "engine/retargeting/rig.h"
#include "sim/choreography/stance.h"

namespace etude {
namespace {

// What moves with each role's joint, in the roles' order: a limb hangs from the joint where it begins.
constexpr std::array<Part, kRoleCount> kPartOfRole = {
    Part::kTrunk,       Part::kTrunk,      Part::kTrunk,      Part::kHead,          Part::kLeftUpperArm,
    Part::kLeftForearm, Part::kLeftHand,   Part::kLeftHand,   Part::kRightUpperArm, Part::kRightForearm,
    Part::kRightHand,   Part::kRightHand,  Part::kLeftThigh,  Part::kLeftShank,     Part::kLeftFoot,
    Part::kLeftFoot,    Part::kRightThigh, Part::kRightShank, Part::kRightFoot,     Part::kRightFoot};

// An ear belongs to the head that it hangs from: the nearest joint upwards that is named after a role decides.
Part PartOfJoint(const Skeleton& skeleton, int joint) {
  for (; joint >= 0; joint = skeleton.joints[joint].parent) {
    if (const auto role = FindRole(skeleton.joints[joint].name)) return kPartOfRole[Index(*role)];
  }
  return Part::kTrunk;
}

Figure FigureAt(const Character& character, const std::vector<GlobalTransform>& globals) {
  Figure figure;
  figure.surfaces.reserve(character.meshes.size());
  for (const SkinnedMesh& mesh : character.meshes) {
    DeformedMesh deformed = Deform(mesh, globals);
    const Material& material = character.materials[mesh.material];
    const glm::dvec3& colour = material.colour;
    figure.surfaces.push_back({.positions = std::move(deformed.positions),
                               .normals = std::move(deformed.normals),
                               .triangles = mesh.triangles,
                               .parts = PartsOfTriangles(character.skeleton, mesh),
                               .colour = {SrgbOfLinear(colour.r), SrgbOfLinear(colour.g), SrgbOfLinear(colour.b)}});
    if (!material.texture) continue;
    figure.surfaces.back().texture = material.texture;
    for (const SkinnedMesh::Vertex& vertex : mesh.vertices) {
      figure.surfaces.back().on_texture.emplace_back(vertex.on_texture);
    }
  }
  return figure;
}

// What hangs from a role's joint was made for the standing body: how much wider, longer and deeper `pose` wants it.
// Limbs keep their shape; hips and chest are as wide as their joints are apart, however long the spine is.
glm::dvec3 SizeOf(Role role, const BodyPose& pose) {
  static const BodyPose standing = StandingPose();
  const auto ratio = [&](Role a, Role b) {
    constexpr double kLeast = 0.2, kMost = 5;  // nobody has such limbs: broken measurements still make a figure
    return std::clamp(glm::distance(pose[a], pose[b]) / glm::distance(standing[a], standing[b]), kLeast, kMost);
  };
  const auto trunk = [](double width, double length) { return glm::dvec3(width, length, 0.5 * (width + length)); };
  using enum Role;
  if (role == kHipCentre) {
    const double width = ratio(kLeftHip, kRightHip);
    return trunk(width, std::max(width, ratio(kHipCentre, kSpine)));  // some spines begin just above the hips
  }
  if (role == kSpine) return trunk(ratio(kLeftShoulder, kRightShoulder), ratio(kSpine, kShoulderCentre));
  if (role == kShoulderCentre) return glm::dvec3(ratio(kLeftShoulder, kRightShoulder));
  for (const Role end : AllRoles()) {
    if (ParentOf(end) == role) return glm::dvec3(ratio(role, end));
  }
  // Where in the head its joint lies is a file's choice: a longer way there is not all size.
  return glm::dvec3(std::sqrt(ratio(*ParentOf(role), role)));
}

}  // namespace

std::vector<Part> PartsOfTriangles(const Skeleton& skeleton, const SkinnedMesh& mesh) {
  std::vector<Part> part_of_binding;
  for (const SkinnedMesh::Binding& binding : mesh.bindings) {
    part_of_binding.push_back(PartOfJoint(skeleton, binding.joint));
  }
  std::vector<Part> parts;
  parts.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    std::array<double, std::tuple_size_v<PartColours>> share{};
    for (const std::uint32_t corner : triangle) {
      const SkinnedMesh::Vertex& vertex = mesh.vertices[corner];
      for (std::size_t i = 0; i < vertex.weights.size(); ++i) {
        if (vertex.weights[i] != 0) {
          share[static_cast<std::size_t>(part_of_binding[vertex.bindings[i]])] += vertex.weights[i];
        }
      }
    }
    parts.push_back(static_cast<Part>(std::ranges::max_element(share) - share.begin()));
  }
  return parts;
}

Figure PosedFigure(const Character& character, const LocalPose& pose, const glm::dmat4& to_world) {
  assert(pose.size() == character.skeleton.joints.size());
  std::vector<GlobalTransform> globals;
  ComputeGlobals(character.skeleton, pose, globals);
  for (GlobalTransform& global : globals) {
    global.position = glm::dvec3(to_world * glm::dvec4(global.position, 1));
    global.axes = glm::dmat3(to_world) * global.axes;
  }
  return FigureAt(character, globals);
}

std::vector<GlobalTransform> FilledGlobals(const Character& character, const BodyPose& pose) {
  std::vector<GlobalTransform> globals;
  ComputeGlobals(character.skeleton, PoseRig(pose, StandingPose()), globals);
  for (const Role role : AllRoles()) {
    glm::dmat3& axes = globals[Index(role)].axes;
    const glm::dvec3 size = SizeOf(role, pose);
    for (int i = 0; i < 3; ++i) axes[i] *= size[i];
  }
  return globals;
}

Figure PosedFigure(const Character& character, const BodyPose& pose) {
  return FigureAt(character, FilledGlobals(character, pose));
}

}  // namespace etude
