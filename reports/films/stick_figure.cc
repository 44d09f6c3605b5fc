#include "reports/films/stick_figure.h"

namespace etude {

glm::dvec2 StickJoint(const BodyPose& pose, Role role, const Box& box, double tall) {
  const double scale = box.height / tall;
  const glm::dvec3& joint = pose[role];
  return {box.x + box.width / 2 + scale * (joint.x - pose[Role::kHipCentre].x),
          box.y + box.height - 6 - scale * joint.y};
}

void DrawStickFigure(Canvas& canvas, const BodyPose& pose, const Box& box, double tall, const Paint& paint) {
  const auto at = [&](Role role) { return StickJoint(pose, role, box, tall); };
  for (const Bone& bone : AllBones()) canvas.DrawLine(at(bone.parent), at(bone.child), 3, paint);
  canvas.DrawDot(at(Role::kHead), 0.09 * box.height / tall, paint);
}

}  // namespace etude
