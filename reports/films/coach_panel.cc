#include "reports/films/coach_panel.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/films/followed_way.h"
#include "reports/films/look.h"
#include "sim/character/characters.h"
#include "sim/character/posed.h"

namespace etude {
namespace {

// A person with raised arms, and some floor, fills the picture.
constexpr double kSeenHeight = 2.65;
constexpr double kDistance = 4.2;
constexpr double kEyeHeight = 1.45;
constexpr double kLookAtHeight = 0.94;
// Drawn this much larger and shrunk, which smooths edges at half the price of RenderSmooth.
constexpr double kDetail = 1.5;
// The camera follows slowly: a second to either side. Standing still also spares drawing the room anew.
constexpr int kFollowFrames = 30;
// How close to the room's wall the hips may come.
constexpr double kNearestToWall = 1.0;
// How long the change stays marked after the seam.
constexpr int kMarkFrames = 15;

std::string TextOf(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

// "seam_frames" when the change went through an in-between clip, else "seam_frame"; those inside the motion.
std::vector<int> SeamsOf(const Json& extras, int frames) {
  const Json all = extras.value("seam_frames", Json::array());
  std::vector<int> seams;
  const auto add = [&](const Json& seam) {
    if (seam.is_number_integer() && seam >= 0 && seam < frames) seams.push_back(seam.get<int>());
  };
  for (const Json& seam : all.is_array() ? all : Json::array()) add(seam);
  if (seams.empty()) add(extras.value("seam_frame", Json()));
  std::ranges::sort(seams);
  return seams;
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

Paint Faded(const Paint& paint) { return {paint.r, paint.g, paint.b, 0.55}; }

}  // namespace

Result<CoachPanel> CoachPanel::Make(const CastCell& cell, int longest) {
  const Json extras = Json::parse(cell.recording->extras_json, nullptr, false);
  const Place place{.file = "recording " + cell.row->Id()};
  if (!extras.is_object()) return Fail(place, "its extras are no JSON object");
  CoachPanel panel;
  panel.bear_ = BearCharacter();
  panel.from_ = ClipInWords(TextOf(extras, "from"));
  panel.to_ = ClipInWords(TextOf(extras, "to"));
  panel.branch_ = TextOf(extras, "branch");
  panel.method_ = cell.row->method;
  panel.motion_ = *FindTrack(*cell.recording, "coach");
  auto& poses = panel.motion_.poses;
  const int count = static_cast<int>(poses.size());
  panel.seams_ = SeamsOf(extras, count);
  if (panel.seams_.empty()) return Fail(place, "its extras lack a whole seam_frame within the motion");
  if (count > longest) {
    const int first = std::clamp(panel.Seam() - longest / 2, 0, count - longest);
    poses = {poses.begin() + first, poses.begin() + first + longest};
    for (int& seam : panel.seams_) seam -= first;
    std::erase_if(panel.seams_, [&](int seam) { return seam >= longest; });
  }
  PutOnStage(panel.motion_, panel.Seam());
  panel.followed_ = FollowedWay(panel.motion_, kFollowFrames);
  return panel;
}

std::string CoachPanel::Title() const { return fmt::format("{} → {}, by {}", from_, to_, method_); }

Camera CoachPanel::CameraAt(int frame, double width, double height) const {
  Intrinsics inside;
  inside.width = static_cast<int>(width);
  inside.height = static_cast<int>(height);
  inside.fx = inside.fy = height * kDistance / kSeenHeight;
  inside.cx = width / 2;
  inside.cy = height / 2;
  const glm::dvec3 hips = followed_[static_cast<std::size_t>(frame)];
  const glm::dvec3 target{hips.x, kLookAtHeight, hips.z};
  return LookAt(inside, target + glm::dvec3{0, kEyeHeight - kLookAtHeight, kDistance}, target);
}

void CoachPanel::Draw(Canvas& canvas, const Box& panel, Renderer& renderer, int frame, bool shown_before) const {
  const BodyPose& pose = motion_.poses[static_cast<std::size_t>(frame)];
  const std::vector<Figure> coach{PosedFigure(bear_, pose)};
  const Camera camera = CameraAt(frame, panel.width * kDetail, panel.height * kDetail);
  canvas.DrawImage(renderer.Render(Room{}, coach, camera, Targets::kColour).colour, panel, kPanelRadius);
  DrawTag(canvas, panel, shown_before ? "The coach · shown again" : "The coach");
  const std::string how = branch_.empty() ? method_ : fmt::format("{} · {}", method_, branch_);
  DrawCaption(canvas, panel, fmt::format("{}  →  {}", from_, to_), "changes moves by " + how, 18);
  DrawTimeline(canvas, panel, frame);
}

void CoachPanel::DrawTimeline(Canvas& canvas, const Box& panel, int frame) const {
  const double left = panel.x + 16, width = panel.width - 32, y = panel.y + panel.height - 18;
  const double last = std::max(1, Frames() - 1);
  const auto place = [&](int at) { return left + width * at / last; };
  const double first = place(seams_.front()), second = place(seams_.back());
  canvas.DrawLine({left, y}, {first, y}, 4, Faded(kAccent));
  canvas.DrawLine({first, y}, {second, y}, 4, Faded(kSoftInk));
  canvas.DrawLine({second, y}, {left + width, y}, 4, Faded(kWarm));
  for (const int seam : seams_) canvas.DrawLine({place(seam), y - 8}, {place(seam), y + 8}, 2, kInk);
  canvas.DrawDot({place(frame), y}, 6, frame < seams_.front() ? kAccent : frame < seams_.back() ? kSoftInk : kWarm);
  const bool just_changed =
      std::ranges::any_of(seams_, [&](int seam) { return frame >= seam && frame < seam + kMarkFrames; });
  if (just_changed) {
    const double label_width = canvas.TextWidth("change", 13, true) + 20;
    const double x = panel.x + panel.width - 12 - label_width;
    canvas.FillBox({x, panel.y + 12, label_width, 24}, kWarm, 12);
    canvas.DrawText({x + 10, panel.y + 28.5}, "change", 13, kBackdrop, label_width, true);
  }
}

}  // namespace etude
