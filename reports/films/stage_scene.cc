#include "reports/films/stage_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "reports/films/look.h"

namespace etude {
namespace {

// Long enough to watch one change of moves; kLongest is short enough to be made in seconds.
constexpr int kShortestScene = 5 * kFilmRate;
// A motion that is shown again rests on its last frame before it starts anew.
constexpr int kRest = kFilmRate / 2;

constexpr Box kCoachBox{12, 52, 812, 656};
constexpr Box kViewBoxes[] = {{836, 52, 432, 324}, {836, 384, 432, 324}};

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
  if (coach_) words += fmt::format("Left: the coach changes moves ({}). ", coach_->Title());
  if (capture_) {
    words += fmt::format(
        "{}: a performer seen by two cameras (cut to the middle); tinted, the person as found in the pictures; over "
        "it, the skeleton recovered from them ({}).",
        coach_ ? "Right" : "Right side", capture_->Title());
  }
  return words;
}

Canvas StageScene::Draw(int frame) {
  Canvas canvas = BeginFrame("one coach, two cameras, every error measured");
  if (coach_) {
    const Shown shown = ShownAt(frame, coach_->Frames());
    coach_->Draw(canvas, kCoachBox, renderer_, shown.frame, shown.before);
  } else {
    DrawEmptyPanel(canvas, kCoachBox, "This run kept no recording of a change of moves.");
  }
  for (std::size_t camera = 0; camera < std::size(kViewBoxes); ++camera) DrawView(canvas, camera, frame);
  return canvas;
}

void StageScene::DrawView(Canvas& canvas, std::size_t camera, int film_frame) {
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
const ColourImage& StageScene::ViewPicture(std::size_t camera, int frame) {
  const auto [kept, is_new] = views_.try_emplace({camera, frame});
  if (is_new) {
    const Box& box = kViewBoxes[camera];
    Canvas canvas(static_cast<int>(box.width), static_cast<int>(box.height));
    capture_->Draw(canvas, renderer_, camera, frame);
    kept->second = canvas.Pixels();
  }
  return kept->second;
}

}  // namespace etude
