#include "sim/character/posed.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/base/image.h"
#include "engine/retargeting/rig.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

// The part that the joint of each role moves, in the roles' order: the limb that begins at the joint.
constexpr std::array<Part, kRoleCount> kPartOfRole = {
    Part::kTrunk,       Part::kTrunk,      Part::kTrunk,      Part::kHead,          Part::kLeftUpperArm,
    Part::kLeftForearm, Part::kLeftHand,   Part::kLeftHand,   Part::kRightUpperArm, Part::kRightForearm,
    Part::kRightHand,   Part::kRightHand,  Part::kLeftThigh,  Part::kLeftShank,     Part::kLeftFoot,
    Part::kLeftFoot,    Part::kRightThigh, Part::kRightShank, Part::kRightFoot,     Part::kRightFoot};

using MaybeParts = std::vector<std::optional<Part>>;  // for each joint, the part that it moves, if any

std::vector<Part> Inherited(const Skeleton& skeleton, const MaybeParts& known) {
  std::vector<Part> parts;
  parts.reserve(known.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    const int parent = skeleton.joints[i].parent;
    parts.push_back(known[i].value_or(parent >= 0 ? parts[static_cast<std::size_t>(parent)] : Part::kTrunk));
  }
  return parts;
}

// Returns the scale of the part at a role's joint relative to the standing body: width, length, depth. Limbs are scaled
// uniformly. The width of hips and chest follows the distance between the hip joints or the shoulder joints, not the
// spine's length.
glm::dvec3 SizeOf(Role role, const BodyPose& pose) {
  static const BodyPose standing = StandingPose();
  const auto ratio = [&](Role a, Role b) {
    constexpr double kMin = 0.2, kMax = 5;  // limits, so that wrong measurements still give a figure
    return std::clamp(glm::distance(pose[a], pose[b]) / glm::distance(standing[a], standing[b]), kMin, kMax);
  };
  const auto trunk = [](double width, double length) { return glm::dvec3(width, length, 0.5 * (width + length)); };
  using enum Role;
  if (role == kHipCentre) {
    const double width = ratio(kLeftHip, kRightHip);
    return trunk(width, std::max(width, ratio(kHipCentre, kSpine)));  // files may put the spine just above the hips
  }
  if (role == kSpine) return trunk(ratio(kLeftShoulder, kRightShoulder), ratio(kSpine, kShoulderCentre));
  if (role == kShoulderCentre) return glm::dvec3(ratio(kLeftShoulder, kRightShoulder));
  for (const Role end : AllRoles()) {
    if (ParentOf(end) == role) return glm::dvec3(ratio(role, end));
  }
  // Scale the head by the square root of the neck's length ratio (shoulder centre to head joint), because files put the
  // head joint at different heights.
  return glm::dvec3(std::sqrt(ratio(*ParentOf(role), role)));
}

glm::dmat4 MatrixOf(const FloorMove& move) {
  const glm::dvec3 origin = move.Apply(glm::dvec3(0));
  const auto axis = [&](const glm::dvec3& along) { return glm::dvec4(move.Apply(along) - origin, 0); };
  return {axis({1, 0, 0}), axis({0, 1, 0}), axis({0, 0, 1}), glm::dvec4(origin, 1)};
}

}  // namespace

std::vector<Part> PartsOfJoints(const Skeleton& skeleton) {
  MaybeParts known(skeleton.joints.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (const auto role = FindRole(skeleton.joints[i].name)) known[i] = kPartOfRole[Index(*role)];
  }
  return Inherited(skeleton, known);
}

std::vector<Part> PartsOfJoints(const Skeleton& skeleton, const JointMap& map) {
  MaybeParts known(skeleton.joints.size());
  const auto part_of = [&known](int joint) -> std::optional<Part>& { return known[static_cast<std::size_t>(joint)]; };
  for (const Role role : AllRoles()) {
    // If several roles share a joint, the joint moves the part of the first of these roles. Leave out the head: the
    // head joint may be a tip, so all joints that move the head are found below.
    if (role != Role::kHead && !part_of(map[role].joint)) part_of(map[role].joint) = kPartOfRole[Index(role)];
  }
  // Assign to the head the head joint and those of its ancestors that carry no shoulder.
  std::vector<bool> carries_shoulder(known.size());
  for (int joint = map[Role::kLeftShoulder].joint; joint >= 0; joint = skeleton.joints[joint].parent) {
    carries_shoulder[static_cast<std::size_t>(joint)] = true;
  }
  for (int joint = map[Role::kHead].joint; !carries_shoulder[static_cast<std::size_t>(joint)] && !part_of(joint);
       joint = skeleton.joints[joint].parent) {
    part_of(joint) = Part::kHead;
  }
  return Inherited(skeleton, known);
}

std::vector<Part> PartsOfTriangles(const std::vector<Part>& parts_of_joints, const SkinnedMesh& mesh) {
  std::vector<Part> parts;
  parts.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    // Sum up the weights of every part over the triangle's corners.
    std::array<double, std::tuple_size_v<PartColours>> share{};
    for (const std::uint32_t corner : triangle) {
      const SkinnedMesh::Vertex& vertex = mesh.vertices[corner];
      for (std::size_t i = 0; i < vertex.weights.size(); ++i) {
        if (vertex.weights[i] == 0) continue;
        const Part part = parts_of_joints[mesh.bindings[vertex.bindings[i]].joint];
        share[static_cast<std::size_t>(part)] += vertex.weights[i];
      }
    }
    parts.push_back(static_cast<Part>(std::ranges::max_element(share) - share.begin()));
  }
  return parts;
}

std::vector<Surface> StillSurfaces(const Character& character, const std::vector<Part>& parts_of_joints) {
  std::vector<Surface> surfaces;
  surfaces.reserve(character.meshes.size());
  for (const SkinnedMesh& mesh : character.meshes) {
    const Material& material = character.materials[mesh.material];
    const glm::dvec3& colour = material.colour;
    Surface& surface = surfaces.emplace_back();
    surface.triangles = mesh.triangles;
    surface.parts = PartsOfTriangles(parts_of_joints, mesh);
    surface.colour = {SrgbOfLinear(colour.r), SrgbOfLinear(colour.g), SrgbOfLinear(colour.b)};
    surface.texture = material.texture;
    if (!material.texture) continue;
    for (const SkinnedMesh::Vertex& vertex : mesh.vertices) surface.on_texture.emplace_back(vertex.on_texture);
  }
  return surfaces;
}

Figure FigureAt(const Character& character, const std::vector<Surface>& still,
                const std::vector<GlobalTransform>& globals) {
  Figure figure;
  figure.surfaces = still;
  for (std::size_t i = 0; i < still.size(); ++i) {
    DeformedMesh deformed = Deform(character.meshes[i], globals);
    figure.surfaces[i].positions = std::move(deformed.positions);
    figure.surfaces[i].normals = std::move(deformed.normals);
  }
  return figure;
}

std::vector<GlobalTransform> GlobalsInWorld(const Skeleton& skeleton, const LocalPose& pose,
                                            const glm::dmat4& to_world) {
  assert(pose.size() == skeleton.joints.size());
  std::vector<GlobalTransform> globals;
  ComputeGlobals(skeleton, pose, globals);
  for (GlobalTransform& global : globals) {
    global.position = glm::dvec3(to_world * glm::dvec4(global.position, 1));
    global.axes = glm::dmat3(to_world) * global.axes;
  }
  return globals;
}

Figure PosedFigure(const Character& character, const LocalPose& pose, const glm::dmat4& to_world) {
  return FigureAt(character, StillSurfaces(character, PartsOfJoints(character.skeleton)),
                  GlobalsInWorld(character.skeleton, pose, to_world));
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

Figure PosedFigure(const Character& character, const BodyPose& pose, bool is_closed) {
  Figure figure =
      FigureAt(character, StillSurfaces(character, PartsOfJoints(character.skeleton)), FilledGlobals(character, pose));
  for (Surface& surface : figure.surfaces) surface.is_closed = is_closed;
  return figure;
}

RecordedFigure::RecordedFigure(std::shared_ptr<const Character> character, Clip clip, const JointMap& map,
                               const BodyConversion& body)
    : character_(std::move(character)),
      clip_(std::move(clip)),
      first_(static_cast<double>(body.dropped_frames)),
      frames_per_frame_(clip_.rate_hz / body.motion.rate_hz),
      to_world_(WorldFromFile(body)),
      still_(StillSurfaces(*character_, PartsOfJoints(character_->skeleton, map))) {}

Figure RecordedFigure::At(double frame, const FloorMove& move) const {
  const LocalPose pose = SampleFrame(clip_, first_ + frame * frames_per_frame_);
  return FigureAt(*character_, still_, GlobalsInWorld(character_->skeleton, pose, MatrixOf(move) * to_world_));
}

}  // namespace etude
