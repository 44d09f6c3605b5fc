#include "reports/films/capture_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/angles.h"
#include "io/drawing/look.h"
#include "io/files/files.h"
#include "io/images/image_files.h"

namespace etude {
namespace {

constexpr std::size_t kShownCameras = 2;

// Returns the frames at one third and two thirds of the capture; both cameras show these frames.
std::array<int, 2> StripFrames(const CapturePanel& capture) { return {capture.Frames() / 3, capture.Frames() * 2 / 3}; }

constexpr std::size_t kPlateCameras = 2, kPlateColumns = 5;
constexpr int kPictureWidth = 232, kPictureHeight = 174;
constexpr double kPlateMargin = 14, kPictureGap = 6, kTitleRoom = 24, kCaptionRoom = 19;
constexpr double kRowTitleSize = 14, kSmallSize = 12;
constexpr double kPlateRowHeight = kTitleRoom + kPictureHeight + kCaptionRoom;
constexpr Paint kVeil{0.04, 0.05, 0.06, 0.55};

/// Returns the rectangle that the whole picture must cover so that the crop around the person fills a canvas of
/// kPictureWidth × kPictureHeight.
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

/// One row of the plate (the picture of DrawPlate): pictures side by side under a title.
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
  over_picture("the person, separated from the background",
               [&](Canvas& canvas) { canvas.DrawMask(Inverse(capture.MaskOf(camera, frame)), panel, kBackdrop); });
  over_picture("marks of hands, feet, head and limbs", [&](Canvas& canvas) {
    canvas.FillBox({0, 0, kPictureWidth, kPictureHeight}, kVeil);
    DrawStrokes(canvas, moment.marks[camera], seen_by, panel);
  });
  over_picture("skeleton with fixed limb lengths",
               [&](Canvas& canvas) { DrawSkeleton(canvas, moment.fixed, seen_by, panel); });
  over_picture("skeleton after inverse kinematics",
               [&](Canvas& canvas) { DrawSkeleton(canvas, capture.Recovered(frame), seen_by, panel); });
}

/// Returns frames evenly spread over the motion.
std::array<int, kPlateColumns> SequenceOf(const CapturePanel& capture) {
  std::array<int, kPlateColumns> frames{};
  for (std::size_t i = 0; i < kPlateColumns; ++i) {
    frames[i] = static_cast<int>(i * static_cast<std::size_t>(capture.Frames() - 1) / (kPlateColumns - 1));
  }
  return frames;
}

constexpr std::array<Box, 2> kSeenBoxes{{{12, 52, 432, 324}, {12, 384, 432, 324}}};
constexpr Box kSkeletonsBox{456, 52, 812, 656};
constexpr double kSkeletonTop = 78, kSkeletonBottom = 62;
constexpr Paint kGround{0.13, 0.15, 0.17, 1};
constexpr Paint kTruthBone{0.62, 0.66, 0.69, 0.85};
// The joint error at which the colour scale ends, centimetres.
constexpr double kMaxErrorCm = 12;

/// Returns green for no error, yellow for half of kMaxErrorCm, red for kMaxErrorCm centimetres and more.
Paint PaintOfError(double cm) {
  const double share = std::clamp(cm / kMaxErrorCm, 0.0, 1.0);
  const double red = std::min(1.0, 2 * share), green = std::min(1.0, 2 - 2 * share);
  return {0.30 + 0.68 * red, 0.32 + 0.50 * green, 0.30, 1};
}

Box ColumnOf(std::size_t index, std::size_t count) {
  constexpr double kBetween = 8;
  const double width =
      std::floor((kSkeletonsBox.width - kBetween * static_cast<double>(count - 1)) / static_cast<double>(count));
  return {kSkeletonsBox.x + static_cast<double>(index) * (width + kBetween), kSkeletonsBox.y, width,
          kSkeletonsBox.height};
}

/// Places a camera slightly to the side of the body's heading, with the whole true motion in view and a margin around
/// this motion.
Camera CameraBefore(const BodyMotion& truth, double width, double height) {
  glm::dvec3 low(1e9), high(-1e9);
  for (const BodyPose& pose : truth.poses) {
    for (const glm::dvec3& joint : pose.joints) low = glm::min(low, joint), high = glm::max(high, joint);
  }
  constexpr double kAway = 6, kAir = 0.35;  // distance of camera and body, margin around the motion, metres
  const double heading = Heading(truth.poses.front()) + Radians(20);
  const glm::dvec3 middle = 0.5 * (low + high);
  const double across = glm::length(glm::dvec2(high.x - low.x, high.z - low.z)) + kAir;
  const double tall = high.y - low.y + kAir;
  Intrinsics inside{.width = static_cast<int>(width), .height = static_cast<int>(height)};
  inside.fx = inside.fy = kAway * std::min(width / across, height / tall);
  inside.cx = width / 2;
  inside.cy = height / 2;
  const glm::dvec3 eye = middle + kAway * glm::dvec3(std::sin(heading), 0.12, std::cos(heading));
  return LookAt(inside, eye, middle);
}

void DrawErrorLegend(Canvas& canvas, const Box& box) {
  constexpr double kSize = 17, kBar = 150;
  const double y = box.y + 26;
  canvas.DrawLine({box.x + 18, y - 6}, {box.x + 46, y - 6}, 8, kTruthBone);
  canvas.DrawText({box.x + 56, y}, "truth", kSize, kSoftInk, 60);
  const double right = box.x + box.width - 18;
  const std::string upper_words = fmt::format("{:g} cm error or more", kMaxErrorCm);
  const double words = canvas.TextWidth(upper_words, kSize);
  canvas.DrawText({right - words, y}, upper_words, kSize, kSoftInk, words + 1);
  const double left = right - words - 12 - kBar;
  for (int i = 0; i < static_cast<int>(kBar); ++i) {
    canvas.FillBox({left + i, y - 12, 1, 12}, PaintOfError(kMaxErrorCm * i / kBar));
  }
  const std::string lower_words = "recovered: 0";
  canvas.DrawText({left - 10 - canvas.TextWidth(lower_words, kSize), y}, lower_words, kSize, kSoftInk, 200);
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

Result<void> SaveStripPictures(const CapturePanel& capture, Renderer& renderer, const FilePath& folder) {
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
  // Measure the size of the plate.
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

  // Draw, for each moment and camera, one row with the pictures of all processing stages.
  for (const CaptureExtras::Moment& moment : capture.Moments()) {
    for (std::size_t camera = 0; camera < cameras; ++camera) {
      PlateRow row = begin_row(fmt::format("T = {}, camera {}", moment.frame + 1, camera + 1));
      DrawMoment(capture, renderer, moment, camera, row);
    }
  }
  // For each camera, draw one row of pictures spread over the whole motion.
  const std::array<int, kPlateColumns> sequence = SequenceOf(capture);
  for (std::size_t camera = 0; camera < cameras; ++camera) {
    PlateRow row = begin_row(fmt::format("The whole sequence, camera {}", camera + 1));
    for (const int frame : sequence) {
      Canvas picture(kPictureWidth, kPictureHeight);
      picture.DrawImage(capture.Seen(renderer, camera, frame, Targets::kColour).colour, PanelOf(capture, camera));
      row.Add(picture, fmt::format("T = {}", frame + 1));
    }
  }
  // Draw one row of recovered skeletons at the frames of the rows above.
  PlateRow row = begin_row("The skeletons of the whole sequence");
  for (const int frame : sequence) {
    Canvas picture(kPictureWidth, kPictureHeight);
    picture.FillBox({0, 0, kPictureWidth, kPictureHeight}, kVeil);
    DrawSkeleton(picture, capture.Recovered(frame), capture.CameraOf(0), PanelOf(capture, 0));
    row.Add(picture, fmt::format("T = {}", frame + 1));
  }
  return PictureOf(plate,
                   fmt::format("The stages of {}, in the layout of paper B's figures 5.3 to 5.15", capture.Title()));
}

Result<std::vector<CapturePanel>> FindCaptures(const RunData& run, const ShownCell& typical) {
  std::vector<CapturePanel> captures;
  for (const std::string& method : typical.scenario->methods) {
    const auto row = std::ranges::find_if(run.rows, [&](const Row& each) {
      return each.scenario == typical.row->scenario && each.trial == typical.row->trial && each.method == method &&
             CompactLabel(each.condition) == CompactLabel(typical.row->condition);
    });
    if (row == run.rows.end() || row->result.status != Status::kOk) continue;
    const auto recorded = std::ranges::find(run.recordings, row->Id(), &CellRecording::cell);
    if (recorded == run.recordings.end() || captures.size() == CaptureScene::kMaxMethods) continue;
    ASSIGN_OR_RETURN(auto panel, CapturePanel::Make(run, {typical.scenario, &*row, &recorded->recording}));
    captures.push_back(std::move(panel));
  }
  return captures;
}

CaptureScene::CaptureScene(Renderer& renderer, std::vector<CapturePanel> captures)
    : renderer_(renderer), captures_(std::move(captures)) {
  const Box column = ColumnOf(0, captures_.size());
  camera_ = CameraBefore(captures_.front().Truth(), column.width, column.height - kSkeletonTop - kSkeletonBottom);
}

int CaptureScene::Frames() const { return std::min(captures_.front().Frames(), kLongest); }

std::string CaptureScene::Methods() const {
  std::string methods;
  for (std::size_t i = 0; i < captures_.size(); ++i) {
    methods += (i == 0 ? "" : i + 1 == captures_.size() ? " and " : ", ") + captures_[i].Method();
  }
  return methods;
}

std::string CaptureScene::Words() const {
  const CapturePanel& first = captures_.front();
  return fmt::format(
      "Left: {} in the pictures of two cameras. The pixels that were recognised as the person are tinted, and the "
      "skeleton of {} is drawn over the pictures. Right: the true skeleton (grey) and the skeleton that {} recovered, "
      "coloured by error.",
      first.Clip().empty() ? "a performer" : first.Clip(), first.Method(), Methods());
}

void CaptureScene::DrawSeen(Canvas& canvas, int frame) const {
  const CapturePanel& first = captures_.front();
  for (std::size_t camera = 0; camera < std::min(kSeenBoxes.size(), first.Cameras()); ++camera) {
    const Box& box = kSeenBoxes[camera];
    Canvas picture(static_cast<int>(box.width), static_cast<int>(box.height));
    first.Draw(picture, renderer_, camera, frame);
    canvas.Put(picture.Copy(), static_cast<int>(box.x), static_cast<int>(box.y), kPanelRadius);
    DrawTag(canvas, box, first.CameraName(camera));
  }
}

void CaptureScene::DrawSkeletons(Canvas& canvas, const CapturePanel& capture, const Box& box, int frame) const {
  const BodyPose& truth = capture.Truth().poses[static_cast<std::size_t>(frame)];
  const BodyPose& recovered = capture.Recovered(frame);
  const auto seen = [&](const glm::dvec3& joint) -> std::optional<glm::dvec2> {
    const auto pixel = Project(camera_, joint);
    // Skip joints far outside the column, because they would cover the neighbouring column.
    if (!pixel || pixel->x < 0 || pixel->x > box.width) return std::nullopt;
    return glm::dvec2(box.x, box.y + kSkeletonTop) + *pixel;
  };
  for (const Bone& bone : AllBones()) {
    const auto from = seen(truth[bone.parent]), to = seen(truth[bone.child]);
    if (from && to) canvas.DrawLine(*from, *to, 9, kTruthBone);
  }
  const auto off_cm = [&](Role role) { return 100 * glm::distance(truth[role], recovered[role]); };
  for (const Bone& bone : AllBones()) {
    const auto from = seen(recovered[bone.parent]), to = seen(recovered[bone.child]);
    if (from && to) canvas.DrawLine(*from, *to, 4, PaintOfError(0.5 * (off_cm(bone.parent) + off_cm(bone.child))));
  }
  for (const Role role : AllRoles()) {
    if (const auto joint = seen(recovered[role])) canvas.DrawDot(*joint, 5, PaintOfError(off_cm(role)));
  }
  canvas.DrawText({box.x + 18, box.y + box.height - 38}, capture.Method(), 22, kInk, box.width - 36, true);
  canvas.DrawText({box.x + 18, box.y + box.height - 14}, capture.ErrorWords(frame), 17, kSoftInk, box.width - 36);
}

Canvas CaptureScene::Draw(int frame) {
  const CapturePanel& first = captures_.front();
  Canvas canvas = BeginFrame(fmt::format("{}{:.1f} s · pictures of two cameras, and the motion recovered from them",
                                         first.Clip().empty() ? "" : first.Clip() + " · ", frame / first.RateHz()));
  DrawSeen(canvas, frame);
  canvas.FillBox(kSkeletonsBox, kGround, kPanelRadius);
  DrawErrorLegend(canvas, kSkeletonsBox);
  for (std::size_t i = 0; i < captures_.size(); ++i) {
    DrawSkeletons(canvas, captures_[i], ColumnOf(i, captures_.size()), frame);
  }
  return canvas;
}

}  // namespace etude
