#include "reports/films/capture_stills.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "bench/files/files.h"
#include "reports/films/look.h"
#include "sim/sensors/image_files.h"

namespace etude {
namespace {

constexpr std::size_t kShownCameras = 2;

// Both cameras at one third and two thirds of the capture.
std::array<int, 2> StripFrames(const CapturePanel& capture) { return {capture.Frames() / 3, capture.Frames() * 2 / 3}; }

constexpr std::size_t kPlateCameras = 2, kPlateColumns = 5;
constexpr int kPictureWidth = 232, kPictureHeight = 174;
constexpr double kPlateMargin = 14, kPictureGap = 6, kTitleRoom = 24, kCaptionRoom = 19;
constexpr double kRowTitleSize = 14, kSmallSize = 12;
constexpr double kPlateRowHeight = kTitleRoom + kPictureHeight + kCaptionRoom;
constexpr Paint kVeil{0.04, 0.05, 0.06, 0.55};

/// Gives the box of the whole picture whose part about the person fills a canvas of kPictureWidth × kPictureHeight.
Box PanelOf(const CapturePanel& capture, std::size_t camera) {
  const Box& crop = capture.CropOf(camera);
  const Intrinsics& in = capture.CameraOf(camera).intrinsics;
  const double scale = std::min(kPictureWidth / crop.width, kPictureHeight / crop.height);
  const glm::dvec2 middle{kPictureWidth / 2.0, kPictureHeight / 2.0};
  return {middle.x - (crop.x + crop.width / 2) * scale, middle.y - (crop.y + crop.height / 2) * scale, in.width * scale,
          in.height * scale};
}

Mask Inverse(Mask mask) {
  for (std::uint8_t& pixel : mask.pixels) pixel = pixel == 0;
  return mask;
}

void DrawStrokes(Canvas& canvas, const std::vector<CaptureExtras::Mark>& marks, const Camera& camera,
                 const Box& panel) {
  const glm::dvec2 scale{panel.width / camera.intrinsics.width, panel.height / camera.intrinsics.height};
  const glm::dvec2 corner{panel.x, panel.y};
  for (const CaptureExtras::Mark& mark : marks) {
    const Paint paint{mark.colour.r / 255.0, mark.colour.g / 255.0, mark.colour.b / 255.0, 1};
    canvas.DrawLine(corner + mark.a * scale, corner + mark.b * scale, 3, paint);
  }
}

/// One row of the plate: pictures beside each other under a title.
class PlateRow {
 public:
  PlateRow(Canvas& canvas, double y, const std::string& title) : canvas_(canvas), y_(y) {
    canvas.DrawText({kPlateMargin, y + 16}, title, kRowTitleSize, kInk, canvas.width() - 2 * kPlateMargin, true);
  }
  void Add(const Canvas& picture, const std::string& caption) {
    canvas_.DrawImage(picture.Pixels(), {x_, y_ + kTitleRoom, kPictureWidth, kPictureHeight});
    canvas_.DrawText({x_, y_ + kTitleRoom + kPictureHeight + 14}, caption, kSmallSize, kSoftInk, kPictureWidth);
    x_ += kPictureWidth + kPictureGap;
  }

 private:
  Canvas& canvas_;
  double x_ = kPlateMargin, y_;
};

void DrawMoment(const CapturePanel& capture, Renderer& renderer, const CaptureExtras::Moment& moment,
                std::size_t camera, PlateRow& row) {
  const int frame = static_cast<int>(moment.frame);
  const Box panel = PanelOf(capture, camera);
  const Camera& seen_by = capture.CameraOf(camera);
  Canvas picture(kPictureWidth, kPictureHeight);
  picture.DrawImage(capture.Seen(renderer, camera, frame, Targets::kColour).colour, panel);
  row.Add(picture, "picture");
  const auto over_picture = [&](const std::string& caption, const auto& draw) {
    Canvas canvas(kPictureWidth, kPictureHeight);
    canvas.DrawImage(picture.Pixels(), {0, 0, kPictureWidth, kPictureHeight});
    draw(canvas);
    row.Add(canvas, caption);
  };
  over_picture("the person, cut out",
               [&](Canvas& canvas) { canvas.DrawMask(Inverse(capture.MaskOf(camera, frame)), panel, kBackdrop); });
  over_picture("ends and limbs, marked", [&](Canvas& canvas) {
    canvas.FillBox({0, 0, kPictureWidth, kPictureHeight}, kVeil);
    DrawStrokes(canvas, moment.marks[camera], seen_by, panel);
  });
  over_picture("limb lengths fixed", [&](Canvas& canvas) { DrawSkeleton(canvas, moment.fixed, seen_by, panel); });
  over_picture("after inverse kinematics",
               [&](Canvas& canvas) { DrawSkeleton(canvas, capture.Recovered(frame), seen_by, panel); });
}

/// Gives frames evenly spread over the motion.
std::array<int, kPlateColumns> SequenceOf(const CapturePanel& capture) {
  std::array<int, kPlateColumns> frames{};
  for (std::size_t i = 0; i < kPlateColumns; ++i) {
    frames[i] = static_cast<int>(i * static_cast<std::size_t>(capture.Frames() - 1) / (kPlateColumns - 1));
  }
  return frames;
}

}  // namespace

std::vector<Picture> DrawStrip(const CapturePanel& capture, Renderer& renderer) {
  std::vector<Picture> strip;
  for (const int frame : StripFrames(capture)) {
    for (std::size_t camera = 0; camera < std::min(kShownCameras, capture.Cameras()); ++camera) {
      Canvas canvas(480, 360);
      capture.Draw(canvas, renderer, camera, frame);
      strip.push_back(
          PictureOf(canvas, fmt::format("{}, {:.1f} s", capture.CameraName(camera), frame / capture.RateHz())));
    }
  }
  return strip;
}

Result<void> SaveStripPictures(const CapturePanel& capture, Renderer& renderer, const std::filesystem::path& folder) {
  for (const int frame : StripFrames(capture)) {
    for (std::size_t camera = 0; camera < std::min(kShownCameras, capture.Cameras()); ++camera) {
      const std::string name = fmt::format("camera-{}-frame-{:03}.exr", camera + 1, frame);
      ASSIGN_OR_RETURN(const auto exr, EncodeExr(capture.Seen(renderer, camera, frame, Targets::kAll)));
      RETURN_IF_ERROR(WriteFileAtomically(folder / name, exr));
    }
  }
  return {};
}

std::optional<Picture> DrawPlate(const CapturePanel& capture, Renderer& renderer) {
  if (capture.Moments().empty()) return std::nullopt;
  const std::size_t cameras = std::min(kPlateCameras, capture.Cameras());
  const std::size_t rows = cameras * (capture.Moments().size() + 1) + 1;
  const double width = 2 * kPlateMargin + kPlateColumns * (kPictureWidth + kPictureGap) - kPictureGap;
  const double height = 2 * kPlateMargin + static_cast<double>(rows) * kPlateRowHeight;
  Canvas plate(static_cast<int>(width), static_cast<int>(height));
  plate.FillBox({0, 0, width, height}, kBackdrop);
  double y = kPlateMargin;
  const auto begin_row = [&](const std::string& title) {
    PlateRow row(plate, y, title);
    y += kPlateRowHeight;
    return row;
  };

  for (const CaptureExtras::Moment& moment : capture.Moments()) {
    for (std::size_t camera = 0; camera < cameras; ++camera) {
      PlateRow row = begin_row(fmt::format("T = {}, camera {}", moment.frame + 1, camera + 1));
      DrawMoment(capture, renderer, moment, camera, row);
    }
  }
  const std::array<int, kPlateColumns> sequence = SequenceOf(capture);
  for (std::size_t camera = 0; camera < cameras; ++camera) {
    PlateRow row = begin_row(fmt::format("The whole sequence, camera {}", camera + 1));
    for (const int frame : sequence) {
      Canvas picture(kPictureWidth, kPictureHeight);
      picture.DrawImage(capture.Seen(renderer, camera, frame, Targets::kColour).colour, PanelOf(capture, camera));
      row.Add(picture, fmt::format("T = {}", frame + 1));
    }
  }
  PlateRow row = begin_row("The whole sequence, its skeletons");
  for (const int frame : sequence) {
    Canvas picture(kPictureWidth, kPictureHeight);
    picture.FillBox({0, 0, kPictureWidth, kPictureHeight}, kVeil);
    DrawSkeleton(picture, capture.Recovered(frame), capture.CameraOf(0), PanelOf(capture, 0));
    row.Add(picture, fmt::format("T = {}", frame + 1));
  }
  return PictureOf(plate,
                   fmt::format("{}, stage by stage, in the layout of paper B's figures 5.3 to 5.15", capture.Title()));
}

}  // namespace etude
