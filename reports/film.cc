#include "reports/film.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "bench/files/files.h"
#include "reports/canvas.h"
#include "reports/capture_panel.h"
#include "reports/cast.h"
#include "reports/coach_panel.h"
#include "reports/encoder.h"
#include "reports/figures.h"
#include "reports/look.h"
#include "sim/sensors/image_files.h"

namespace etude {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr int kRate = 30;
// Long enough to watch one change of moves, short enough to be made in seconds.
constexpr int kShortest = 5 * kRate, kLongest = 7 * kRate;
// A motion that is shown again rests on its last frame before it starts anew.
constexpr int kRest = kRate / 2;

constexpr Box kCoachBox{12, 52, 812, 656};
constexpr Box kViewBoxes[] = {{836, 52, 432, 324}, {836, 384, 432, 324}};
constexpr std::size_t kShownCameras = std::size(kViewBoxes);

// Which frame of a motion is seen at a frame of the film.
struct Shown {
  int frame;
  bool before;  ///< it has been seen whole already
};
Shown ShownAt(int film_frame, int length) {
  const int round = film_frame % (length + kRest);
  return {std::min(round, length - 1), film_frame >= length + kRest};
}

class Film {
 public:
  Film(Renderer& renderer, std::optional<CoachPanel> coach, std::optional<CapturePanel> capture)
      : renderer_(renderer), coach_(std::move(coach)), capture_(std::move(capture)) {}

  int Frames() const { return std::clamp(coach_ ? coach_->Frames() : capture_->Frames(), kShortest, kLongest); }
  // The moment that tells most: just after the change of moves.
  int PosterFrame() const { return std::min(coach_ ? coach_->Seam() + 4 : capture_->Frames() / 2, Frames() - 1); }

  std::string Words() const {
    std::string words;
    if (coach_) words += fmt::format("Left: the coach changes moves ({}). ", coach_->Title());
    if (capture_) {
      words += fmt::format(
          "{}: a performer seen by two cameras (cut to the middle); tinted, the person as found in the pictures; over "
          "it, the skeleton recovered from them ({}).",
          coach_ ? "Right" : "Right side", capture_->Title());
    }
    return words;
  }

  Canvas Draw(int film_frame) {
    Canvas canvas(kWidth, kHeight);
    canvas.FillBox({0, 0, kWidth, kHeight}, kBackdrop);
    canvas.DrawText({16, 34}, "Etude", 20, kInk, 120, true);
    canvas.DrawText({92, 33}, "one coach, two cameras, every error measured", 14, kSoftInk, 700);
    if (coach_) {
      const Shown shown = ShownAt(film_frame, coach_->Frames());
      coach_->Draw(canvas, kCoachBox, renderer_, shown.frame, shown.before);
    } else {
      DrawEmptyPanel(canvas, kCoachBox, "This run kept no recording of a change of moves.");
    }
    for (std::size_t camera = 0; camera < kShownCameras; ++camera) DrawView(canvas, camera, film_frame);
    return canvas;
  }

 private:
  void DrawView(Canvas& canvas, std::size_t camera, int film_frame) {
    const Box& box = kViewBoxes[camera];
    if (!capture_ || camera >= capture_->Cameras()) {
      DrawEmptyPanel(canvas, box, "This run kept no recording of a capture.");
      return;
    }
    const Shown shown = ShownAt(film_frame, capture_->Frames());
    canvas.DrawImage(ViewPicture(camera, shown.frame), box, kPanelRadius);
    DrawTag(canvas, box, capture_->CameraName(camera) + (shown.before ? " · shown again" : ""));
    DrawCaption(canvas, box, "", capture_->ErrorWords(shown.frame));
  }

  // Captures are often shorter than the film and then seen again: each picture is drawn once.
  const ColourImage& ViewPicture(std::size_t camera, int frame) {
    const auto [kept, is_new] = views_.try_emplace({camera, frame});
    if (is_new) {
      const Box& box = kViewBoxes[camera];
      Canvas canvas(static_cast<int>(box.width), static_cast<int>(box.height));
      capture_->Draw(canvas, renderer_, camera, frame);
      kept->second = canvas.Pixels();
    }
    return kept->second;
  }

  Renderer& renderer_;
  std::optional<CoachPanel> coach_;
  std::optional<CapturePanel> capture_;
  std::map<std::pair<std::size_t, int>, ColourImage> views_;
};

Picture PictureOf(const Canvas& canvas, std::string caption) {
  return {canvas.Png(), canvas.width(), canvas.height(), std::move(caption)};
}

Result<std::string> Encode(Film& film, const std::filesystem::path& path) {
  auto encoder = Encoder::Start(path, kWidth, kHeight, kRate);
  if (!encoder) return tl::unexpected(encoder.error());
  for (int frame = 0; frame < film.Frames(); ++frame) {
    if (auto added = encoder->Add(film.Draw(frame).Pixels()); !added) return tl::unexpected(added.error());
  }
  if (auto finished = encoder->Finish(); !finished) return tl::unexpected(finished.error());
  return ReadWholeFile(path);
}

// Both cameras at one third and two thirds of the capture.
std::array<int, 2> StripFrames(const CapturePanel& capture) { return {capture.Frames() / 3, capture.Frames() * 2 / 3}; }

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

// The same moments with everything that is known of them, for other programs.
Result<void> SaveStripPictures(const CapturePanel& capture, Renderer& renderer, const std::filesystem::path& folder) {
  if (auto made = MakeFolder(folder); !made) return made;
  for (const int frame : StripFrames(capture)) {
    for (std::size_t camera = 0; camera < std::min(kShownCameras, capture.Cameras()); ++camera) {
      const std::string name = fmt::format("camera-{}-frame-{:03}.exr", camera + 1, frame);
      auto saved = SaveExr(capture.Seen(renderer, camera, frame, Targets::kAll), (folder / name).string());
      if (!saved) return saved;
    }
  }
  return {};
}

}  // namespace

Media MakeMedia(const RunData& run, const MediaPaths& paths) {
  Media media;
  const auto note = [&](const std::string& why) { media.why_no_film += (media.why_no_film.empty() ? "" : " ") + why; };
  const auto coach_cell = ChooseCell(run, "transition", "coach");
  const auto capture_cell = ChooseCell(run, "capture", "recovered");
  if (!coach_cell && !capture_cell) {
    note("There is no film: this run kept no recordings of a coach or a capture.");
    return media;
  }
  auto renderer = Renderer::Create();
  if (!renderer) {
    note("There are no pictures: " + ToString(renderer.error()));
    return media;
  }

  std::optional<CoachPanel> coach;
  std::optional<CapturePanel> capture;
  if (coach_cell) {
    if (auto made = CoachPanel::Make(*coach_cell, kLongest)) {
      coach = std::move(*made);
    } else {
      note("The coach cannot be shown: " + ToString(made.error()));
    }
  }
  if (capture_cell) {
    if (auto made = CapturePanel::Make(run, *capture_cell)) {
      media.strip = DrawStrip(*made, **renderer);
      media.strip_scenario = capture_cell->scenario->name;
      if (auto saved = SaveStripPictures(*made, **renderer, paths.pictures); !saved) note(ToString(saved.error()));
      capture = std::move(*made);
    } else {
      note("The capture cannot be shown: " + ToString(made.error()));
    }
  }
  if (!coach && !capture) return media;

  Film film(**renderer, std::move(coach), std::move(capture));
  media.film_caption = film.Words();
  media.poster = PictureOf(film.Draw(film.PosterFrame()), media.film_caption);
  if (auto mp4 = Encode(film, paths.film)) {
    media.mp4 = std::move(*mp4);
  } else {
    note("There is no film, only this picture: " + ToString(mp4.error()));
  }
  return media;
}

}  // namespace etude
