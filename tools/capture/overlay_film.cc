#include "tools/capture/overlay_film.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "io/drawing/canvas.h"
#include "io/drawing/look.h"

namespace etude {
namespace {

constexpr double kMaxHeight = 720;
constexpr double kMaxWidth = 1920;
constexpr Paint kLeftLimb{0.25, 0.75, 1.0, 0.95}, kRightLimb{1.0, 0.55, 0.2, 0.95}, kMiddleLimb{1, 1, 1, 0.95},
    kDot{0.3, 1.0, 0.3, 0.8};

Paint PaintOf(Role role) {
  const std::string_view name = RoleName(role);
  return name.starts_with("left_") ? kLeftLimb : name.starts_with("right_") ? kRightLimb : kMiddleLimb;
}

/// Computes the boxes of the films, side by side, and the size of the whole picture.
std::vector<Box> Layout(std::span<const OverlayView> views, int& width, int& height) {
  double sum = 0;
  for (const OverlayView& view : views) sum += static_cast<double>(view.facts.width) / view.facts.height;
  const double tall = std::min(kMaxHeight, kMaxWidth / sum);
  std::vector<Box> boxes;
  double x = 0;
  for (const OverlayView& view : views) {
    const double wide = std::round(tall * view.facts.width / view.facts.height);
    boxes.push_back({x, 0, wide, std::round(tall)});
    x += wide;
  }
  width = static_cast<int>(x) / 2 * 2;  // the encoder requires even numbers
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
    DrawTag(canvas, box_, view_.name);
  }

 private:
  bool IsInside(const glm::dvec2& film) const {
    return film.x >= 0 && film.y >= 0 && film.x <= view_.facts.width && film.y <= view_.facts.height;
  }
  glm::dvec2 OnCanvas(const glm::dvec2& film) const {
    return {box_.x + film.x * box_.width / view_.facts.width, box_.y + film.y * box_.height / view_.facts.height};
  }
  /// Returns the pixel at which the camera shows a point; nullopt if the pixel lies outside the film.
  std::optional<glm::dvec2> PixelOf(const glm::dvec3& place) const {
    const auto rig = Project(view_.camera, place);
    if (!rig || !IsInside(view_.fit.ToFilm(*rig))) return std::nullopt;
    return OnCanvas(view_.fit.ToFilm(*rig));
  }

  const OverlayView& view_;
  const Box box_;
};

/// Reads the pictures of a film in order.
class FilmReader {
 public:
  static Result<FilmReader> Start(const OverlayView& view) {
    ASSIGN_OR_RETURN(Decoder decoder, Decoder::Start(view.film, view.facts));
    return FilmReader(view, std::move(decoder));
  }

  /// Returns the film's picture that is nearest in time to a frame of the motion. Call it with ascending frames.
  Result<const ColourImage*> At(std::size_t frame) {
    const long even = std::clamp(std::lround((static_cast<double>(frame) - view_->offset) / (1 + view_->drift)), 0l,
                                 static_cast<long>(view_->facts.EvenFrames()) - 1);
    const int wanted = view_->facts.PictureAt(static_cast<int>(even));
    for (; shown_ < wanted; ++shown_) {
      ASSIGN_OR_RETURN(const bool is_there, decoder_.Next(picture_));
      if (!is_there) return Fail({view_->film.string()}, "ends before frame {}", wanted + 1);
    }
    return &picture_;
  }

 private:
  FilmReader(const OverlayView& view, Decoder decoder) : view_(&view), decoder_(std::move(decoder)) {}

  const OverlayView* view_;
  Decoder decoder_;
  ColourImage picture_;
  int shown_ = -1;
};

/// Reads all films in parallel, and writes their pictures into one buffer, one after the other.
class FilmReaders {
 public:
  static Result<FilmReaders> Start(std::span<const OverlayView> views) {
    FilmReaders all;
    for (const OverlayView& view : views) {
      ASSIGN_OR_RETURN(FilmReader reader, FilmReader::Start(view));
      all.readers_.push_back(std::move(reader));
      all.bytes_ += BytesOf(view);
    }
    return all;
  }

  std::size_t bytes() const { return bytes_; }
  /// Writes the films' pictures for a frame of the motion. Call it with ascending frames.
  Result<void> Write(std::size_t frame, std::span<std::uint8_t> into) {
    for (FilmReader& reader : readers_) {
      ASSIGN_OR_RETURN(const ColourImage* picture, reader.At(frame));
      const std::size_t count = picture->pixels.size() * sizeof(Rgb8);
      std::memcpy(into.data(), picture->pixels.data(), count);
      into = into.subspan(count);
    }
    return {};
  }
  /// Takes the first picture of the buffer `from`, and moves `from` to the next picture.
  static ColourImage TakePicture(const OverlayView& view, std::span<const std::uint8_t>& from) {
    ColourImage picture(view.facts.width, view.facts.height);
    std::memcpy(picture.pixels.data(), from.data(), BytesOf(view));
    from = from.subspan(BytesOf(view));
    return picture;
  }

 private:
  static std::size_t BytesOf(const OverlayView& view) {
    return static_cast<std::size_t>(view.facts.width) * static_cast<std::size_t>(view.facts.height) * sizeof(Rgb8);
  }

  std::vector<FilmReader> readers_;
  std::size_t bytes_ = 0;
};

}  // namespace

Result<bool> WriteOverlayFilm(const std::filesystem::path& path, std::span<const OverlayView> views,
                              const BodyMotion& motion, const FilmWatch& watch, Picture* middle) {
  int width = 0, height = 0;
  const std::vector<Box> boxes = Layout(views, width, height);
  std::vector<ViewPainter> painters;
  for (std::size_t i = 0; i < views.size(); ++i) painters.emplace_back(views[i], boxes[i]);
  ASSIGN_OR_RETURN(FilmReaders readers, FilmReaders::Start(views));
  const std::size_t frames = motion.poses.size();
  const auto draw = [&](int at, std::span<const std::uint8_t> pictures) {
    const auto frame = static_cast<std::size_t>(at);
    Canvas canvas(width, height);
    for (std::size_t i = 0; i < views.size(); ++i) {
      painters[i].Draw(canvas, FilmReaders::TakePicture(views[i], pictures), motion.poses[frame], frame);
    }
    return canvas;
  };
  const auto fill = [&](int frame, std::span<std::uint8_t> into) -> Result<void> {
    RETURN_IF_ERROR(readers.Write(static_cast<std::size_t>(frame), into));
    if (middle && frame == static_cast<int>(frames / 2)) *middle = PictureOf(draw(frame, into), middle->caption);
    return {};
  };
  return EncodeFedFrames(path, static_cast<int>(frames), motion.rate_hz, {readers.bytes(), fill}, draw, watch);
}

}  // namespace etude
