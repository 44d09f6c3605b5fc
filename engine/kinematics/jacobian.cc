#include "engine/kinematics/jacobian.h"

namespace etude {

void ComputeJacobian(const KinematicTree& tree, const TreeFrames& frames, TreeJacobian& out) {
  out.rows = TreeJacobian::kPerEffector * static_cast<int>(tree.effectors.size());
  out.values.assign(static_cast<std::size_t>(out.rows) * tree.dof_count(), 0.0);
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    for (int j = tree.effectors[e].joint; j >= 0; j = tree.joints[j].parent) {
      const TreeJoint& joint = tree.joints[j];
      const glm::dvec3 p_LE_W = frames.effectors[e].position - frames.joints[j].position;
      for (int dof = joint.first_dof; dof < joint.first_dof + joint.dof_count; ++dof) {
        const glm::dvec3& axis_W = frames.dof_axes[dof];
        const glm::dvec3 moves = glm::cross(axis_W, p_LE_W);
        double* cell = &out.values[static_cast<std::size_t>(dof) * out.rows + TreeJacobian::kPerEffector * e];
        for (int k = 0; k < 3; ++k) {
          cell[k] = moves[k];
          cell[3 + k] = axis_W[k];
        }
      }
    }
  }
}

}  // namespace etude
