#include "bench/tasks/capture/marking.h"

#include <algorithm>
#include <cmath>

#include "bench/tasks/capture/shooting.h"
#include "engine/base/directions.h"
#include "sim/annotator/drawing.h"
#include "sim/annotator/evidence.h"
#include "sim/body/shape.h"

namespace etude {
namespace {

Marks DrawAndRead(const Marks& marks, const AnnotatedPicture& picture) {
  return ReadMarks(DrawMarks(marks, picture.labels.width, picture.labels.height));
}

// Returns the marked position of each joint: the mean of the ends of the strokes that meet there, or the disc at a
// limb's end.
std::array<std::optional<glm::dvec2>, kRoleCount> JointsOf(const Marks& marks) {
  std::array<glm::dvec2, kRoleCount> sum{};
  std::array<int, kRoleCount> count{};
  const auto add = [&](Role role, const glm::dvec2& pixel) {
    sum[Index(role)] += pixel;
    ++count[Index(role)];
  };
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (!marks.strokes[i]) continue;
    add(StrokeMarks()[i].from, marks.strokes[i]->a);
    add(StrokeMarks()[i].to, marks.strokes[i]->b);
  }
  std::array<std::optional<glm::dvec2>, kRoleCount> joints;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    if (count[i] > 0) joints[i] = sum[i] / static_cast<double>(count[i]);
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    if (marks.effectors[i]) joints[Index(EffectorMarks()[i].role)] = marks.effectors[i];
  }
  return joints;
}

std::optional<glm::dvec2> MiddleOf(const std::optional<PixelSegment>& stroke) {
  if (!stroke) return std::nullopt;
  return 0.5 * (stroke->a + stroke->b);
}

/// Returns the colours of the performer's suit, one per stroke.
LimbColours SuitOf(const PartColours& colours) {
  const auto of = [&](Part part) { return colours[static_cast<std::size_t>(part)]; };
  LimbColours suit{.trunk = of(Part::kTrunk), .limbs = {}};
  for (std::size_t i = 0; i < kStrokeCount; ++i) suit.limbs[i] = of(kLimbParts[i].limb);
  return suit;
}

}  // namespace

Marks MeanMarks(const Marks& first, const Marks& second) {
  Marks mean = first;
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    const auto& other = second.strokes[i];
    auto& stroke = mean.strokes[i];
    if (stroke && other) stroke = PixelSegment{0.5 * (stroke->a + other->a), 0.5 * (stroke->b + other->b)};
    if (!stroke) stroke = other;
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    const auto& other = second.effectors[i];
    auto& disc = mean.effectors[i];
    if (disc && other) disc = 0.5 * (*disc + *other);
    if (!disc) disc = other;
  }
  return mean;
}

double HeadBelowCrown(const Figure& figure, const BodyPose& body) {
  const glm::dvec3 up = UnitOr(body[Role::kHead] - body[Role::kShoulderCentre], {0, 1, 0});
  const glm::dvec3 shoulders = body[Role::kLeftShoulder] - body[Role::kRightShoulder];
  const glm::dvec3 aside = UnitOr(shoulders - glm::dot(shoulders, up) * up, {1, 0, 0});
  double crown = 0, half_width = 0;
  const auto extend = [&](const glm::dvec3& p, double radius) {
    const glm::dvec3 from_head = p - body[Role::kHead];
    crown = std::max(crown, glm::dot(from_head, up) + radius);
    half_width = std::max(half_width, std::abs(glm::dot(from_head, aside)) + radius);
  };
  for (const Capsule& capsule : figure.shape) {
    if (capsule.part != Part::kHead) continue;
    extend(capsule.a, capsule.radius);
    extend(capsule.b, capsule.radius);
  }
  for (const Surface& surface : figure.surfaces) {
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
      if (surface.parts[i] != Part::kHead) continue;
      for (const std::uint32_t corner : surface.triangles[i]) extend(surface.positions[corner], 0);
    }
  }
  return half_width > 0 ? crown / half_width : 0;
}

Marking::Marking(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key)
    : mark_every_(static_cast<std::size_t>(options.mark_every)), annotators_(world.cameras.size()) {
  const PersonErrors errors{.error_px = options.annotation_error_px};
  const BodyPose& body = world.truth.front();
  eye_.look.figure = world.own || world.stage.IsPerformerDressed() ? FigureKind::kDressed : FigureKind::kCapsules;
  suit_ = SuitOf(world.colours);
  eye_.look.head_below_crown = HeadBelowCrown(PerformerAt(world, 0), body);
  for (std::size_t camera = 0; camera < annotators_.size(); ++camera) {
    for (int annotator = 0; annotator < options.annotators; ++annotator) {
      annotators_[camera].emplace_back(errors, eye_, key, annotator, static_cast<int>(camera));
    }
  }
}

Marks Marking::MarkTrueJoints(std::size_t frame, const AnnotatedPicture& picture, const Camera& camera,
                              const BodyPose& pose) const {
  Marks marks;
  if (frame % mark_every_ != 0) return marks;
  const PictureEvidence seen = SeePicture(picture, eye_);
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (!seen.limbs[i]) continue;
    const auto a = Project(camera, pose[StrokeMarks()[i].from]), b = Project(camera, pose[StrokeMarks()[i].to]);
    if (a && b) marks.strokes[i] = PixelSegment{*a, *b};
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    const Role role = EffectorMarks()[i].role;
    if (seen.joints[Index(role)]) marks.effectors[i] = Project(camera, pose[role]);
  }
  return marks;
}

Marks Marking::ReadColours(std::size_t frame, const AnnotatedPicture& picture) const {
  if (frame % mark_every_ != 0) return {};
  return ReadLimbColours(picture.colours, picture.person, suit_, {.look = eye_.look, .margin_px = eye_.margin_px});
}

Marks Marking::Mark(std::size_t camera, std::size_t frame, const AnnotatedPicture& picture) {
  if (frame % mark_every_ != 0) return {};
  std::vector<Marks> drawn;
  for (Annotator& annotator : annotators_[camera]) {
    drawn.push_back(DrawAndRead(annotator.Mark(static_cast<int>(frame), picture), picture));
  }
  if (drawn.size() == 1) return drawn[0];
  Compare(drawn[0], drawn[1]);
  return MeanMarks(drawn[0], drawn[1]);
}

void Marking::Compare(const Marks& first, const Marks& second) {
  const auto a = JointsOf(first), b = JointsOf(second);
  for (std::size_t i = 0; i < kRoleCount; ++i) joints_.push_back({a[i], b[i]});
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    limbs_.push_back({MiddleOf(first.strokes[i]), MiddleOf(second.strokes[i])});
  }
}

}  // namespace etude
