#include "engine/bundle_adjustment/measurable_body.h"

#include <cassert>

namespace etude {
namespace {

constexpr int kRootColumns = 6;

void AddAngleGains(const KinematicTree& tree, const TreeFrames& frames, const BodyPoint& point, const glm::dvec3& p_WQ,
                   glm::dvec3* gains) {
  for (int j = point.joint; j >= 0; j = tree.joints[j].parent) {
    const TreeJoint& joint = tree.joints[j];
    for (int dof = joint.first_dof; dof < joint.first_dof + joint.dof_count; ++dof) {
      gains[kRootColumns + dof] = glm::cross(frames.dof_axes[dof], p_WQ - frames.joints[j].position);
    }
  }
}

// Returns true if moving the joint moves the point, that is, if the joint is on the path from the root to the point's
// limb.
bool Carries(const KinematicTree& tree, int joint, const BodyPoint& point) {
  int j = point.joint;
  while (j > joint) j = tree.joints[j].parent;
  return j == joint;
}

}  // namespace

MeasurableBody WithLengths(const MeasurableBody& body, std::span<const double> lengths) {
  assert(lengths.size() == body.lengths.size());
  MeasurableBody changed = body;
  changed.lengths.assign(lengths.begin(), lengths.end());
  const auto growth = [&](const LengthShare& share) {
    return (lengths[share.length] - body.lengths[share.length]) * share.per_metre;
  };
  for (const LengthShare& share : body.joint_shares) changed.tree.joints[share.index].p_PJ += growth(share);
  for (const LengthShare& share : body.point_shares) changed.points[share.index].p_LQ += growth(share);
  return changed;
}

void PlacePoints(const MeasurableBody& body, const TreeState& state, bool wants_gains, PlacedPoints& out) {
  // Compute the positions of all points.
  const TreeFrames frames = ComputeFrames(body.tree, state);
  const int first_length = kRootColumns + body.tree.dof_count();
  out.columns = first_length + static_cast<int>(body.lengths.size());
  out.positions.resize(body.points.size());
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    const LimbFrame& X_WL = frames.joints[body.points[i].joint];
    out.positions[i] = X_WL.position + X_WL.axes * body.points[i].p_LQ;
  }
  if (!wants_gains) return;
  out.gains.assign(body.points.size() * out.columns, glm::dvec3(0));
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    const BodyPoint& point = body.points[i];
    glm::dvec3* gains = out.gains.data() + i * out.columns;
    // Fill the columns of the root, of the angles, and of the lengths of joints between root and point.
    for (int k = 0; k < 3; ++k) {
      glm::dvec3 axis(0);
      axis[k] = 1;
      gains[k] = axis;
      gains[3 + k] = glm::cross(axis, out.positions[i] - state.root_position);
    }
    AddAngleGains(body.tree, frames, point, out.positions[i], gains);
    for (const LengthShare& share : body.joint_shares) {
      const int parent = body.tree.joints[share.index].parent;
      if (parent < 0 || !Carries(body.tree, share.index, point)) continue;
      gains[first_length + share.length] += frames.joints[parent].axes * share.per_metre;
    }
  }
  // Add the lengths on which the points' own offsets depend.
  for (const LengthShare& share : body.point_shares) {
    const BodyPoint& point = body.points[share.index];
    out.gains[static_cast<std::size_t>(share.index) * out.columns + first_length + share.length] +=
        frames.joints[point.joint].axes * share.per_metre;
  }
}

}  // namespace etude
