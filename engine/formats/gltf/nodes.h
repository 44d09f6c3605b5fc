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
  std::vector<int> joint_of;    ///< joint of each node; −1 for nodes that are not joints
  std::vector<int> mesh_nodes;  ///< nodes of the scene that have a mesh, ascending
};

/// Reads the nodes of the default scene. Without a default scene it reads the nodes of the first scene, and without
/// scenes all nodes. Nodes outside of the scene are included if they are animated or joints of a skin, with all their
/// ancestors. Joints are in the file's order, but parents come first. A node that only holds a skinned mesh is not a
/// joint, because such a mesh follows only its skin's joints. Matrices become translation, rotation and scale; unnamed
/// nodes are called "node_<index>", and duplicate names are numbered (UniqueNames).
///
/// Returns an error for indices out of range, cycles, a second parent, more than 1,024 joints, nesting deeper than 128
/// levels, matrices that shear, flatten or project, and rotations of length 0.
Result<GltfNodes> ReadGltfNodes(const GltfFile& file);

/// Returns an error if a joint's global position or axes exceed ±10⁹ in this pose: scales and translations multiply
/// along the hierarchy, so the product of allowed numbers may be too large.
Result<void> CheckGltfPose(const GltfFile& file, const Skeleton& skeleton, const LocalPose& pose,
                           const std::string& where);

/// Returns true if the squared length of a vector or quaternion is 1 within the precision of floats. Such vectors are
/// left as they are, so that reading and writing a file does not change them.
bool IsUnit(double square_length);

/// Returns the rotation of a quaternion in glTF's order x, y, z, w, of any length above 0.
glm::dquat RotationFrom(const double* xyzw);

}  // namespace etude
