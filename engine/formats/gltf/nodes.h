#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/gltf/file.h"
#include "engine/motion/clip.h"

namespace etude {

/// The nodes of a file as a skeleton.
struct GltfNodes {
  Skeleton skeleton;
  std::vector<int> joint_of;    ///< per node, −1 for nodes that are no joints
  std::vector<int> mesh_nodes;  ///< nodes of the scene that hold a mesh, ascending
};

/// The nodes of the default scene (else of the first, else all nodes), and from outside the scene those that are
/// animated or joints of a skin, with all that is above them. In the file's order, but parents first. A node that does
/// nothing but hold a skinned mesh is no joint: such a mesh follows its skin's joints alone. Matrices become
/// translation, rotation and scale; unnamed nodes are called
/// "node_<index>", doubled names are numbered (UniqueNames).
///
/// Refused: indices out of range, cycles, two parents, over 1,024 joints, nesting over 128, matrices that shear,
/// flatten or project, rotations of length 0.
Result<GltfNodes> ReadGltfNodes(const GltfFile& file);

/// Refuses a pose in which a joint's place or axes in the world pass ±10⁹: small numbers multiply on the way down.
Result<void> CheckGltfPose(const GltfFile& file, const Skeleton& skeleton, const LocalPose& pose,
                           const std::string& where);

/// Says whether a vector's or quaternion's square of length is 1 as far as floats can tell. Such ones are taken as they
/// stand in the file, so that writing and reading change nothing; others are made unit.
bool IsUnit(double square_length);

/// The rotation of a quaternion in glTF's order x, y, z, w, of any length but 0.
glm::dquat RotationFrom(const double* xyzw);

}  // namespace etude
