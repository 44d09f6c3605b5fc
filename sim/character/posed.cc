#include "sim/character/posed.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

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

// Each triangle belongs to the part whose joints move its corners most.
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

// The curve of IEC 61966-2-1.
std::uint8_t ToSrgb(double linear) {
  const double clamped = std::clamp(linear, 0.0, 1.0);
  const double curved = clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * curved));
}

}  // namespace

Figure PosedFigure(const Character& character, const LocalPose& pose, const glm::dmat4& to_world) {
  assert(pose.size() == character.skeleton.joints.size());
  std::vector<GlobalTransform> globals;
  ComputeGlobals(character.skeleton, pose, globals);
  for (GlobalTransform& global : globals) {
    global.position = glm::dvec3(to_world * glm::dvec4(global.position, 1));
    global.axes = glm::dmat3(to_world) * global.axes;
  }
  Figure figure;
  figure.surfaces.reserve(character.meshes.size());
  for (const SkinnedMesh& mesh : character.meshes) {
    DeformedMesh deformed = Deform(mesh, globals);
    const glm::dvec3& colour = character.materials[mesh.material].colour;
    figure.surfaces.push_back({.positions = std::move(deformed.positions),
                               .normals = std::move(deformed.normals),
                               .triangles = mesh.triangles,
                               .parts = PartsOfTriangles(character.skeleton, mesh),
                               .colour = {ToSrgb(colour.r), ToSrgb(colour.g), ToSrgb(colour.b)}});
  }
  return figure;
}

Figure PosedFigure(const Character& character, const BodyPose& pose) {
  return PosedFigure(character, PoseRig(StandingPose(), pose));
}

}  // namespace etude
