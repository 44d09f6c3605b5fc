#include "reports/films/overlay_film.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/films/encoder.h"
#include "reports/films/canvas.h"

namespace etude {
namespace {

constexpr double kTallest = 720;
constexpr double kWidest = 1920;
constexpr Paint kLeftLimb{0.25, 0.75, 1.0, 0.95}, kRightLimb{1.0, 0.55, 0.2, 0.95}, kMiddleLimb{1, 1, 1, 0.95},
    kDot{0.3, 1.0, 0.3, 0.8}, kLabel{1, 1, 1, 0.9};

Paint PaintOf(Role role) {
  const std::string_view name = RoleName(role);
  return name.starts_with("left_") ? kLeftLimb : name.starts_with("right_") ? kRightLimb : kMiddleLimb;
}

/// Lays the films out side by side.
std::vector<Box> Layout(std::span<const OverlayView> views, int& width, int& height) {
  double sum = 0;
  for (const OverlayView& view : views) sum += static_cast<double>(view.facts.width) / view.facts.height;
  const double tall = std::min(kTallest, kWidest / sum);
  std::vector<Box> boxes;
  double x = 0;
  for (const OverlayView& view : views) {
    const double wide = std::round(tall * view.facts.width / view.facts.height);
    boxes.push_back({x, 0, wide, std::round(tall)});
    x += wide;
  }
  width = static_cast<int>(x) / 2 * 2;  // the encoder wants even numbers
  height = static_cast<int>(std::round(tall)) / 2 * 2;
  return boxes;
}

class ViewPainter {
 public:
  ViewPainter(const OverlayView& view, const Box& box) : view_(view), box_(box) {}

  void Draw(Canvas& canvas, const ColourImage& picture, const BodyPose& pose, std::size_t frame) const {
    canvas.DrawImage(picture, box_);
    for (const Bone& bone : AllBones()) {
      const auto from = PixelOf(pose[bone.parent]), to = PixelOf(pose[bone.child]);
      if (from && to) canvas.DrawLine(*from, *to, 3, PaintOf(bone.child));
    }
    if (const auto& seen = view_.keypoints[frame]) {
      for (const Keypoint& keypoint : seen->keypoints) {
        if (keypoint.confidence > 0 && IsInside(keypoint.pixel)) canvas.DrawDot(OnCanvas(keypoint.pixel), 2.5, kDot);
      }
    }
    canvas.DrawText({box_.x + 8, box_.y + 20}, view_.name, 15, kLabel, box_.width - 16);
  }

 private:
  bool IsInside(const glm::dvec2& film) const {
    return film.x >= 0 && film.y >= 0 && film.x <= view_.facts.width && film.y <= view_.facts.height;
  }
  glm::dvec2 OnCanvas(const glm::dvec2& film) const {
    return {box_.x + film.x * box_.width / view_.facts.width, box_.y + film.y * box_.height / view_.facts.height};
  }
  /// Gives the pixel of a place; nothing outside the film.
  std::optional<glm::dvec2> PixelOf(const glm::dvec3& place) const {
    const auto rig = Project(view_.camera, place);
    if (!rig || !IsInside(view_.fit.ToFilm(*rig))) return std::nullopt;
    return OnCanvas(view_.fit.ToFilm(*rig));
  }

  const OverlayView& view_;
  const Box box_;
};

/// A film's pictures, from the first to the last.
class FilmRoll {
 public:
  static Result<FilmRoll> Start(const OverlayView& view) {
    ASSIGN_OR_RETURN(Decoder decoder, Decoder::Start(view.film, view.facts));
    return FilmRoll(view, std::move(decoder));
  }

  /// Gives the picture nearest to that frame of the motion, which is no earlier than the one before.
  Result<const ColourImage*> At(std::size_t frame) {
    const long wanted = std::clamp(std::lround((static_cast<double>(frame) - view_->offset) / (1 + view_->drift)), 0l,
                                   static_cast<long>(view_->facts.frames) - 1);
    for (; shown_ < wanted; ++shown_) {
      ASSIGN_OR_RETURN(const bool is_there, decoder_.Next(picture_));
      if (!is_there) return Fail({view_->film.string()}, "ends before frame {}", wanted + 1);
    }
    return &picture_;
  }

 private:
  FilmRoll(const OverlayView& view, Decoder decoder) : view_(&view), decoder_(std::move(decoder)) {}

  const OverlayView* view_;
  Decoder decoder_;
  ColourImage picture_;
  long shown_ = -1;
};

}  // namespace

Result<bool> WriteOverlayFilm(const std::filesystem::path& path, std::span<const OverlayView> views,
                              const BodyMotion& motion, const FilmWatch& watch, Picture* middle) {
  int width = 0, height = 0;
  const std::vector<Box> boxes = Layout(views, width, height);
  std::vector<ViewPainter> painters;
  std::vector<FilmRoll> rolls;
  for (std::size_t i = 0; i < views.size(); ++i) {
    painters.emplace_back(views[i], boxes[i]);
    ASSIGN_OR_RETURN(FilmRoll roll, FilmRoll::Start(views[i]));
    rolls.push_back(std::move(roll));
  }
  const int rate = std::max(1, static_cast<int>(std::lround(motion.rate_hz)));
  ASSIGN_OR_RETURN(Encoder encoder, Encoder::Start(path, width, height, rate));
  for (std::size_t frame = 0; frame < motion.poses.size(); ++frame) {
    if (watch.IsStopped()) return false;
    Canvas canvas(width, height);
    for (std::size_t i = 0; i < views.size(); ++i) {
      ASSIGN_OR_RETURN(const ColourImage* picture, rolls[i].At(frame));
      painters[i].Draw(canvas, *picture, motion.poses[frame], frame);
    }
    RETURN_IF_ERROR(encoder.Add(canvas.Pixels()));
    if (middle && frame == motion.poses.size() / 2) *middle = PictureOf(canvas, middle->caption);
    watch.Tell(path, frame + 1, motion.poses.size());
  }
  RETURN_IF_ERROR(encoder.Finish());
  return true;
}

}  // namespace etude
