#include "reports/films/session_parts.h"

#include <algorithm>
#include <array>

#include "io/drawing/look.h"

namespace etude {
namespace {

constexpr double kTimelineBarsFrom = 96, kTimelineBar = 26, kTimelineGap = 8;

double TopOf(int row) { return SessionTimeline::kBox.y + 12 + row * (kTimelineBar + kTimelineGap); }

}  // namespace

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

std::string_view PlainNameOf(Feature feature) {
  constexpr std::array<std::string_view, kFeatureCount> kNames = {"right arm",  "left arm", "right elbow", "left elbow",
                                                                  "height",     "trunk",    "right leg",   "left leg",
                                                                  "right knee", "left knee"};
  return kNames[static_cast<std::size_t>(feature)];
}

Paint PaintOfWord(const std::string& word) {
  return word == "right" ? kRightPaint : word == "wrong" ? kWrongPaint : kUndecidedPaint;
}

SessionTimeline::SessionTimeline(Canvas& canvas, const FrameSpan& shown) : canvas_(canvas), shown_(shown) {
  canvas_.FillBox(kBox, {0.13, 0.15, 0.17, 1}, kPanelRadius);
}

double SessionTimeline::XOf(int frame) const {
  const double left = kBox.x + kTimelineBarsFrom, width = kBox.width - kTimelineBarsFrom - 12;
  const int length = shown_.end - shown_.begin;
  return left + width * std::clamp(frame - shown_.begin, 0, length) / std::max(1, length);
}

void SessionTimeline::Label(int row, const std::string& text) {
  canvas_.DrawText({kBox.x + 12, TopOf(row) + 18}, text, 16, kSoftInk, kTimelineBarsFrom - 16);
}

void SessionTimeline::Bar(int row, int begin, int end, const Paint& paint) {
  const double left = XOf(begin), right = XOf(end);
  if (right > left) canvas_.FillBox({left, TopOf(row), right - left - 1, kTimelineBar}, paint, 4);
}

void SessionTimeline::Text(int row, int begin, int end, const std::string& text) {
  constexpr double kSize = 16;
  const double left = XOf(begin), room = XOf(end) - left - 8;
  if (canvas_.TextWidth(text, kSize) <= room)
    canvas_.DrawText({left + 5, TopOf(row) + 19}, text, kSize, kBackdrop, room);
}

void SessionTimeline::Tick(int frame, int first_row, int last_row, const Paint& paint) {
  canvas_.DrawLine({XOf(frame), TopOf(first_row) - 5}, {XOf(frame), TopOf(last_row) + kTimelineBar + 5}, 2,
                   paint);
}

}  // namespace etude
