#include "engine/capture/mark_errors.h"

#include <array>
#include <cmath>

namespace etude {
namespace {

// Of an end of a stroke: exact across it, less so along it.
glm::dmat2 InformationOfEnd(const PixelSegment& stroke, const MarkErrors& errors) {
  const glm::dvec2 limb = stroke.b - stroke.a;
  const double length = glm::length(limb);
  const double across = errors.mark_error_px, along = std::hypot(across, errors.slide_share * length);
  if (!(length > 0)) return glm::dmat2(1 / (across * across));
  const glm::dvec2 t = limb / length, n(-t.y, t.x);
  return glm::outerProduct(t, t) / (along * along) + glm::outerProduct(n, n) / (across * across);
}

// A disc lies over the end of its limb's stroke, which is read too short.
bool HasDisc(const Marks& marks, Role role) {
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    if (EffectorMarks()[i].role == role) return marks.effectors[i].has_value();
  }
  return false;
}

}  // namespace

std::vector<MarkedJoint> MarkedJointsOf(const Marks& marks, const MarkErrors& errors) {
  std::vector<MarkedJoint> joints;
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (!marks.strokes[i]) continue;
    const glm::dmat2 information = InformationOfEnd(*marks.strokes[i], errors);
    joints.push_back({StrokeMarks()[i].from, marks.strokes[i]->a, information});
    if (!HasDisc(marks, StrokeMarks()[i].to)) joints.push_back({StrokeMarks()[i].to, marks.strokes[i]->b, information});
  }
  const glm::dmat2 of_disc(1 / (errors.mark_error_px * errors.mark_error_px));
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    if (marks.effectors[i]) joints.push_back({EffectorMarks()[i].role, *marks.effectors[i], of_disc});
  }
  std::array<int, kRoleCount> count{};
  for (const MarkedJoint& joint : joints) ++count[Index(joint.role)];
  for (MarkedJoint& joint : joints) joint.information /= static_cast<double>(count[Index(joint.role)]);
  return joints;
}

}  // namespace etude
