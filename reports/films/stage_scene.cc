#include "reports/films/stage_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "reports/films/look.h"

namespace etude {
namespace {

// Long enough to watch one change of moves; kLongest is short enough to be made in seconds.
constexpr int kShortestScene = 5 * kFilmRate;
// A motion that is shown again rests on its last frame before it starts anew.
constexpr int kRest = kFilmRate / 2;

// The frame belongs to what there is: both together, or one of them alone.
constexpr Box kCoachBesideViews{12, 52, 812, 656}, kCoachAlone{12, 52, 1256, 656};
using ViewBoxes = std::array<Box, 2>;
constexpr ViewBoxes kViewsBesideCoach{{{836, 52, 432, 324}, {836, 384, 432, 324}}};
constexpr ViewBoxes kViewsAlone{{{12, 146, 623, 467}, {645, 146, 623, 467}}};

// Which frame of a motion is seen at a frame of the film.
struct Shown {
  int frame;
  bool before;  ///< it has been seen whole already
};
Shown ShownAt(int film_frame, int length) {
  const int round = film_frame % (length + kRest);
  return {std::min(round, length - 1), film_frame >= length + kRest};
}

}  // namespace

StageScene::StageScene(Renderer& renderer, std::optional<CoachPanel> coach, std::optional<CapturePanel> capture)
    : renderer_(renderer), coach_(std::move(coach)), capture_(std::move(capture)) {}

int StageScene::Frames() const {
  return std::clamp(coach_ ? coach_->Frames() : capture_->Frames(), kShortestScene, kLongest);
}

// Just after the change of moves.
int StageScene::PosterFrame() const {
  return std::min(coach_ ? coach_->FirstPoint() + 4 : capture_->Frames() / 2, Frames() - 1);
}

std::string StageScene::Words() const {
  std::string words;
  if (coach_) words += fmt::format("{} coach changes moves ({}). ", capture_ ? "Left: the" : "The", coach_->Title());
  if (capture_) {
    words += fmt::format(
        "{} performer seen by two cameras (cut to the middle); tinted, the person as found in the pictures; over "
        "it, the skeleton recovered from them ({}).",
        coach_ ? "Right: a" : "A", capture_->Title());
  }
  return words;
}

Canvas StageScene::Draw(int frame) {
  Canvas canvas = BeginFrame(!capture_ ? "one coach, every distance measured"
                             : coach_  ? "one coach, two cameras, every error measured"
                                       : "two cameras, every error measured");
  if (coach_) {
    const Shown shown = ShownAt(frame, coach_->Frames());
    coach_->Draw(canvas, capture_ ? kCoachBesideViews : kCoachAlone, renderer_, shown.frame, shown.before);
  }
  if (!capture_) return canvas;
  const ViewBoxes& boxes = coach_ ? kViewsBesideCoach : kViewsAlone;
  const Shown shown = ShownAt(frame, capture_->Frames());
  for (std::size_t camera = 0; camera < std::min(boxes.size(), capture_->Cameras()); ++camera) {
    const Box& box = boxes[camera];
    canvas.DrawImage(ViewPicture(camera, shown.frame, box), box, kPanelRadius);
    DrawTag(canvas, box, capture_->CameraName(camera) + (shown.before ? " · shown again" : ""));
    DrawCaption(canvas, box, "", capture_->ErrorWords(shown.frame));
  }
  return canvas;
}

// Captures are often shorter than the film and then seen again: each picture is drawn once.
const ColourImage& StageScene::ViewPicture(std::size_t camera, int frame, const Box& box) {
  const auto [kept, is_new] = views_.try_emplace({camera, frame});
  if (is_new) {
    Canvas canvas(static_cast<int>(box.width), static_cast<int>(box.height));
    capture_->Draw(canvas, renderer_, camera, frame);
    kept->second = canvas.Pixels();
  }
  return kept->second;
}

}  // namespace etude
