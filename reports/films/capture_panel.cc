#include "reports/films/capture_panel.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "reports/transitions/recorded_requests.h"

namespace etude {
namespace {

constexpr Paint kMaskTint{0.20, 0.78, 0.86, 0.24};
constexpr Paint kMaskEdge{0.25, 0.88, 0.95, 0.95};
constexpr Paint kBoneShadow{0.05, 0.06, 0.07, 0.75};
constexpr Paint kLeftSide{1.0, 0.80, 0.30, 1};
constexpr Paint kRightSide{0.98, 0.98, 1.0, 1};

bool IsLeft(Role role) { return role != Mirrored(role) && Index(role) < Index(Mirrored(role)); }

struct ProjectedJoints {
  std::array<std::optional<glm::dvec2>, kRoleCount> points;
};

ProjectedJoints ProjectAll(const BodyPose& pose, const Camera& camera, const Box& panel) {
  const glm::dvec2 scale{panel.width / camera.intrinsics.width, panel.height / camera.intrinsics.height};
  ProjectedJoints projected;
  for (const Role role : AllRoles()) {
    const auto pixel = Project(camera, pose[role]);
    // Skip points far outside the picture: such points are invisible, and cairo's fixed-point coordinates would
    // overflow.
    if (!pixel || glm::length(*pixel) > 1e4) continue;
    projected.points[Index(role)] = glm::dvec2{panel.x, panel.y} + *pixel * scale;
  }
  return projected;
}

void DrawJoints(Canvas& canvas, const ProjectedJoints& joints) {
  const auto draw_bones = [&](double width, bool shadow) {
    for (const Bone& bone : AllBones()) {
      const auto &from = joints.points[Index(bone.parent)], &to = joints.points[Index(bone.child)];
      if (!from || !to) continue;
      canvas.DrawLine(*from, *to, width, shadow ? kBoneShadow : IsLeft(bone.child) ? kLeftSide : kRightSide);
    }
  };
  draw_bones(5, true);
  draw_bones(2.4, false);
  for (const Role role : AllRoles()) {
    const auto& point = joints.points[Index(role)];
    if (!point) continue;
    canvas.DrawDot(*point, 3.6, kBoneShadow);
    canvas.DrawDot(*point, 2.6, IsLeft(role) ? kLeftSide : kRightSide);
  }
}

// Tints the picture's pixels that belong to the mask; a recorded mask has half the picture's width and height.
void Tint(const Mask& mask, const Paint& paint, ColourImage& picture) {
  std::array<std::array<std::uint8_t, 256>, 3> tinted;
  for (int value = 0; value < 256; ++value) {
    const auto mix = [&](double over) { return std::lround(std::lerp(value, 255 * over, paint.a)); };
    tinted[0][value] = static_cast<std::uint8_t>(mix(paint.r));
    tinted[1][value] = static_cast<std::uint8_t>(mix(paint.g));
    tinted[2][value] = static_cast<std::uint8_t>(mix(paint.b));
  }
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (mask.At(x * mask.width / picture.width, y * mask.height / picture.height) == 0) continue;
      Rgb8& pixel = picture.At(x, y);
      pixel = {tinted[0][pixel.r], tinted[1][pixel.g], tinted[2][pixel.b]};
    }
  }
}

// Returns a crop of the pictures that contains the person in every frame, with a margin. The crop has the pictures'
// aspect ratio.
Box CropAround(const BodyMotion& motion, const Camera& camera) {
  constexpr double kAirPixels = 45;
  const glm::dvec2 size{camera.intrinsics.width, camera.intrinsics.height};
  glm::dvec2 low = size, high{0};
  for (const BodyPose& pose : motion.poses) {
    for (const glm::dvec3& joint : pose.joints) {
      const auto pixel = Project(camera, joint);
      if (!pixel) continue;
      low = glm::min(low, *pixel - kAirPixels);
      high = glm::max(high, *pixel + kAirPixels);
    }
  }
  const glm::dvec2 wanted = (high - low) / size;
  const double share = std::clamp(std::max(wanted.x, wanted.y), 0.3, 1.0);
  const glm::dvec2 corner = glm::clamp((low + high - share * size) / 2.0, glm::dvec2{0}, size * (1 - share));
  return {corner.x, corner.y, share * size.x, share * size.y};
}

StagedRoom StageOf(const CaptureExtras& extras, const BodyMotion& truth) {
  std::vector<Camera> cameras;
  for (const CaptureExtras::View& view : extras.views) cameras.push_back(view.truth);
  const Wardrobe wardrobe = extras.wears_coded      ? Wardrobe::kCoded
                            : extras.wears_everyday ? Wardrobe::kEveryday
                                                    : Wardrobe::kStudio;
  return StagedRoom({.seed = extras.stage_seed, .scene = extras.scene, .wardrobe = wardrobe}, truth.poses, cameras);
}

}  // namespace

void DrawSkeleton(Canvas& canvas, const BodyPose& pose, const Camera& camera, const Box& panel) {
  DrawJoints(canvas, ProjectAll(pose, camera, panel));
}

Mask OutlineOf(const Mask& mask) {
  Mask outline(mask.width, mask.height);
  const auto set = [&](int x, int y) { return mask.Contains(x, y) && mask.At(x, y) != 0; };
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      const bool inside = set(x - 1, y) && set(x + 1, y) && set(x, y - 1) && set(x, y + 1);
      outline.At(x, y) = set(x, y) && !inside;
    }
  }
  return outline;
}

Result<CapturePanel> CapturePanel::Make(const RunData& run, const ShownCell& cell) {
  // Read the true and the recovered motion and the extras of the recording, and check that the lengths of these three
  // match.
  const Place place{.file = "recording " + cell.row->Id()};
  const BodyMotion* truth = FindTrack(*cell.recording, "truth");
  const BodyMotion* recovered = FindTrack(*cell.recording, "recovered");
  if (truth == nullptr || recovered == nullptr) return Fail(place, "has no tracks 'truth' and 'recovered'");
  ASSIGN_OR_RETURN(auto extras, ReadCaptureExtras(cell.recording->extras_json));

  const std::size_t frames = truth->poses.size();
  bool fits =
      frames > 0 && recovered->poses.size() == frames && extras.brightness.size() == frames && !extras.views.empty();
  for (const auto& view : extras.views) fits = fits && view.masks.size() == frames;
  if (!fits)
    return Fail(place,
                "the tracks, masks and brightness of the recording differ in length, or the recording has no camera");

  // Rebuild the room in which the person moved, and find the crop of each camera's pictures.
  CapturePanel panel;
  panel.truth_ = *truth;
  panel.recovered_ = *recovered;
  panel.extras_ = std::move(extras);
  panel.stage_ = StageOf(panel.extras_, panel.truth_);
  for (const auto& view : panel.extras_.views) {
    panel.crops_.push_back(CropAround(panel.truth_, view.truth));
    panel.lenses_.emplace_back(view.truth);
  }
  panel.method_ = cell.row->method;
  panel.clip_ = ClipInWords(cell.row->clip);
  // Read the mean joint error of the cell, and the joint error of each frame if the run recorded it.
  panel.error_mm_ = ValueOf(*cell.row, "mpjpe_mm");
  if (const Series* errors = FindSeries(run, *cell.row, "mpjpe_mm");
      errors != nullptr && errors->values.size() == frames) {
    panel.errors_mm_ = errors->values;
  }
  return panel;
}

std::string CapturePanel::CameraName(std::size_t camera) const {
  if (Cameras() != 2) return fmt::format("Camera {}", camera + 1);
  return camera == 0 ? "First camera" : "Second camera";
}

std::vector<Still> CapturePanel::Stills() const {
  std::vector<Still> stills;
  for (std::size_t camera = 0; camera < Cameras(); ++camera) {
    const std::string& still = extras_.views[camera].still_jpeg_base64;
    if (still.empty()) continue;
    stills.push_back({still, fmt::format("{}, as filmed, {:.1f} s", CameraName(camera),
                                         static_cast<double>(Frames() / 2) / RateHz())});
  }
  return stills;
}

std::string CapturePanel::Title() const { return clip_.empty() ? method_ : fmt::format("{} on {}", method_, clip_); }

std::string CapturePanel::ErrorWords(int frame) const {
  std::string words;
  if (!errors_mm_.empty()) words = fmt::format("error {:.0f} mm now", errors_mm_[static_cast<std::size_t>(frame)]);
  if (error_mm_) words += fmt::format("{}{:.0f} mm on average", words.empty() ? "" : ", ", *error_mm_);
  return words;
}

View CapturePanel::Seen(Renderer& renderer, std::size_t camera, int frame, Targets targets) const {
  const std::size_t k = static_cast<std::size_t>(frame);
  const double seconds = static_cast<double>(frame) / truth_.rate_hz;
  const Room room{.texture_seed = extras_.texture_seed,
                  .brightness = extras_.brightness[k] * stage_.FlickerAt(seconds),
                  .casts_shadows = extras_.casts_shadows,
                  .interior = stage_.interior()};
  std::vector<Figure> figures = stage_.MoversAt(seconds);
  figures.push_back(stage_.PerformerAt(truth_.poses[k], extras_.colours));
  const LensWarp& lens = lenses_[camera];
  return lens.Warp(renderer.Render(room, figures, lens.pinhole(), targets));
}

void CapturePanel::Draw(Canvas& canvas, Renderer& renderer, std::size_t camera, int frame) const {
  const std::size_t k = static_cast<std::size_t>(frame);
  const CaptureExtras::View& view = extras_.views[camera];
  // Scale the whole picture so that the crop fills the canvas; the canvas cuts off the rest.
  const Box& crop = crops_[camera];
  const double scale = canvas.width() / crop.width;
  const Intrinsics& inside = view.truth.intrinsics;
  const Box panel{-crop.x * scale, -crop.y * scale, inside.width * scale, inside.height * scale};
  // Tint the picture before it is scaled, because scaling takes most of a frame's time.
  ColourImage picture = Seen(renderer, camera, frame, Targets::kColour).colour;
  Tint(view.masks[k], kMaskTint, picture);
  Tint(OutlineOf(view.masks[k]), kMaskEdge, picture);
  canvas.DrawImage(picture, panel);
  DrawSkeleton(canvas, recovered_.poses[k], view.truth, panel);
}

}  // namespace etude
