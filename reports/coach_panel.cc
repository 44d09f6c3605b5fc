#include "reports/coach_panel.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/look.h"

namespace etude {
namespace {

// A person with raised arms, and some floor, fills the picture.
constexpr double kSeenHeight = 2.55;
constexpr double kDistance = 4.2;
constexpr double kEyeHeight = 1.45;
constexpr double kLookAtHeight = 1.02;
// The camera follows slowly: the way of the hips averaged over a second to either side.
constexpr int kFollowFrames = 30;
// How close to the room's wall the hips may come.
constexpr double kNearestToWall = 1.0;
// How long the change stays marked after the seam.
constexpr int kMarkFrames = 15;

using Json = nlohmann::json;

std::string TextOf(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

// Turned to face the camera at the seam, in the middle of the room, never behind its wall.
void PutOnStage(BodyMotion& motion, int seam) {
  const FloorMove move = ToOrigin(motion.poses[static_cast<std::size_t>(seam)]);
  double backmost = 0;
  for (BodyPose& pose : motion.poses) {
    pose = move.Apply(pose);
    backmost = std::min(backmost, pose[Role::kHipCentre].z);
  }
  const FloorMove forward{0, 0, std::max(0.0, kWallZ + kNearestToWall - backmost)};
  for (BodyPose& pose : motion.poses) pose = forward.Apply(pose);
}

std::vector<glm::dvec3> SmoothedHips(const BodyMotion& motion) {
  const int count = static_cast<int>(motion.poses.size());
  std::vector<glm::dvec3> way;
  for (int frame = 0; frame < count; ++frame) {
    glm::dvec3 sum{0};
    for (int k = -kFollowFrames; k <= kFollowFrames; ++k) {
      sum += motion.poses[static_cast<std::size_t>(std::clamp(frame + k, 0, count - 1))][Role::kHipCentre];
    }
    way.push_back(sum / (2.0 * kFollowFrames + 1));
  }
  return way;
}

}  // namespace

Result<CoachPanel> CoachPanel::Make(const CastCell& cell, int longest) {
  const Json extras = Json::parse(cell.recording->extras_json, nullptr, false);
  const Place place{.file = "recording " + cell.row->Id()};
  if (!extras.is_object()) return Fail(place, "its extras are no JSON object");
  const auto seam = extras.find("seam_frame");
  if (seam == extras.end() || !seam->is_number_integer()) return Fail(place, "its extras lack a whole seam_frame");

  CoachPanel panel;
  panel.from_ = TextOf(extras, "from");
  panel.to_ = TextOf(extras, "to");
  panel.branch_ = TextOf(extras, "branch");
  panel.method_ = cell.row->method;
  panel.motion_ = *FindTrack(*cell.recording, "coach");
  auto& poses = panel.motion_.poses;
  const int count = static_cast<int>(poses.size());
  panel.seam_ = static_cast<int>(std::clamp<long long>(seam->get<long long>(), 0, count - 1));
  if (count > longest) {
    const int first = std::clamp(panel.seam_ - longest / 2, 0, count - longest);
    poses = {poses.begin() + first, poses.begin() + first + longest};
    panel.seam_ -= first;
  }
  PutOnStage(panel.motion_, panel.seam_);
  panel.followed_ = SmoothedHips(panel.motion_);
  return panel;
}

std::string CoachPanel::Title() const { return fmt::format("{} → {}, by {}", from_, to_, method_); }

Camera CoachPanel::CameraAt(int frame, const Box& panel) const {
  Intrinsics inside;
  inside.width = static_cast<int>(panel.width);
  inside.height = static_cast<int>(panel.height);
  inside.fx = inside.fy = panel.height * kDistance / kSeenHeight;
  inside.cx = panel.width / 2;
  inside.cy = panel.height / 2;
  const glm::dvec3 hips = followed_[static_cast<std::size_t>(frame)];
  const glm::dvec3 target{hips.x, kLookAtHeight, hips.z};
  return LookAt(inside, target + glm::dvec3{0, kEyeHeight - kLookAtHeight, kDistance}, target);
}

void CoachPanel::Draw(Canvas& canvas, const Box& panel, Renderer& renderer, int frame, bool shown_before) const {
  const BodyPose& pose = motion_.poses[static_cast<std::size_t>(frame)];
  const std::vector<Figure> coach{{BodyCapsules(pose), CoachColours()}};
  canvas.DrawImage(renderer.RenderSmooth(Room{}, coach, CameraAt(frame, panel)), panel, kPanelRadius);
  DrawTag(canvas, panel, shown_before ? "The coach · shown again" : "The coach");
  const std::string how = branch_.empty() ? method_ : fmt::format("{} · {}", method_, branch_);
  DrawCaption(canvas, panel, fmt::format("{}  →  {}", from_, to_), "changes moves by " + how, 18);
  DrawTimeline(canvas, panel, frame);
}

void CoachPanel::DrawTimeline(Canvas& canvas, const Box& panel, int frame) const {
  const double left = panel.x + 16, width = panel.width - 32, y = panel.y + panel.height - 18;
  const double last = std::max(1, Frames() - 1);
  const double seam = left + width * seam_ / last, now = left + width * frame / last;
  canvas.DrawLine({left, y}, {seam, y}, 4, {kAccent.r, kAccent.g, kAccent.b, 0.55});
  canvas.DrawLine({seam, y}, {left + width, y}, 4, {kWarm.r, kWarm.g, kWarm.b, 0.55});
  canvas.DrawLine({seam, y - 8}, {seam, y + 8}, 2, kInk);
  canvas.DrawDot({now, y}, 6, frame < seam_ ? kAccent : kWarm);
  if (frame >= seam_ && frame < seam_ + kMarkFrames) {
    const double label_width = canvas.TextWidth("change", 13, true) + 20;
    const double x = std::clamp(seam - label_width / 2, left, left + width - label_width);
    canvas.FillBox({x, y - 38, label_width, 24}, kWarm, 12);
    canvas.DrawText({x + 10, y - 21.5}, "change", 13, kBackdrop, label_width, true);
  }
}

}  // namespace etude
