#include "tools/clips/clip_film.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/retargeting/proportions.h"
#include "io/drawing/look.h"
#include "sim/body/shape.h"
#include "sim/character/characters.h"
#include "sim/character/posed.h"
#include "sim/choreography/canonical_body.h"
#include "tools/clips/clip_facts.h"

namespace etude {
namespace {

PartColours SidedColours() {
  constexpr Rgb8 kMiddle{196, 200, 206}, kLeft{74, 190, 200}, kRight{238, 150, 82};
  PartColours colours;
  colours.fill(kMiddle);
  for (const Part part : {Part::kLeftUpperArm, Part::kLeftForearm, Part::kLeftHand, Part::kLeftThigh, Part::kLeftShank,
                          Part::kLeftFoot}) {
    colours[static_cast<std::size_t>(part)] = kLeft;
  }
  for (const Part part : {Part::kRightUpperArm, Part::kRightForearm, Part::kRightHand, Part::kRightThigh,
                          Part::kRightShank, Part::kRightFoot}) {
    colours[static_cast<std::size_t>(part)] = kRight;
  }
  return colours;
}

constexpr double kDot = 0.012;  // radius of the dots on hand and foot, as a share of the picture's height

double TurnFor(Viewpoint from) {
  switch (from) {
    case Viewpoint::kFront:
      return 0;
    case Viewpoint::kThreeQuarter:
      return Radians(40);
    case Viewpoint::kSide:
      break;
  }
  return Radians(90);
}

// Pictures are rendered larger by this factor and then shrunk, which smooths edges (supersampling). Rough edges are
// less visible in motion, so a smaller factor than for contact sheets (2) is enough.
constexpr double kDetail = 1.5;
// The camera path is averaged over this many frames (half a second) to either side.
constexpr int kSmoothing = 15;
// The maximum number of frames from which the bounds of the view are computed.
constexpr int kLookedAt = 200;

}  // namespace

Result<ClipActor> ClipActor::Make(OpenedClip clip, std::optional<ActorKind> kind) {
  const bool has_own = clip.source.character != nullptr;
  if (!kind) {
    const bool is_builtin = clip.source.format == ClipFormat::kBuiltin;
    kind = has_own ? ActorKind::kOwn : is_builtin ? ActorKind::kBear : ActorKind::kMannequin;
  }
  if (*kind == ActorKind::kOwn && !has_own) {
    return Fail({clip.source.source, 0, 0}, "the file contains no figure (meshes); allowed: bear, mannequin, body");
  }
  return ClipActor(std::move(clip), *kind);
}

ClipActor::ClipActor(OpenedClip clip, ActorKind kind)
    : clip_(std::move(clip)), kind_(kind), motion_(clip_.body.motion) {
  const SourceClip& source = clip_.source;
  if (kind_ == ActorKind::kOwn) own_.emplace(source.character, source.clip, clip_.map, clip_.body);
  if (kind_ == ActorKind::kMannequin) character_ = std::make_shared<const Character>(MannequinCharacter());
  if (kind_ == ActorKind::kBear) {
    character_ = std::make_shared<const Character>(BearCharacter());
    motion_ = Retarget(motion_, StandingPose());
  }
}

Figure ClipActor::FigureAt(std::size_t frame) const {
  const BodyPose& pose = motion_.poses[frame];
  switch (kind_) {
    case ActorKind::kBody:
      return {BodyCapsules(pose), SidedColours(), {}};
    case ActorKind::kOwn:
      return own_->At(static_cast<double>(frame));
    case ActorKind::kMannequin:
    case ActorKind::kBear:
      break;
  }
  return PosedFigure(*character_, pose, /*is_closed=*/true);
}

Shot::Shot(ClipActor actor, Viewpoint from, int smoothing) : actor_(std::move(actor)) {
  const BodyMotion& motion = actor_.motion();
  const FloorMove turn{TurnFor(from) - Heading(motion.poses.front()), 0, 0};
  for (const glm::dvec3& followed : CameraPath(motion, smoothing)) {
    const glm::dvec3 turned = turn.Apply(followed);
    placements_.push_back({turn.yaw, -turned.x, -turned.z});
  }
}

Figure Shot::PlacedFigure(int frame) const {
  return Placed(actor_.FigureAt(static_cast<std::size_t>(frame)), PlacementAt(frame));
}

void Shot::Include(const std::vector<int>& frames, ViewBounds& bounds) const {
  for (const int frame : frames) Studio::Include(PlacedFigure(frame), bounds);
}

void Shot::Draw(Canvas& canvas, const Box& box, Studio& studio, Renderer& renderer, int frame) const {
  const FloorMove& placement = PlacementAt(frame);
  studio.Draw(canvas, box, renderer, PlacedFigure(frame), placement);
  const BodyPose& pose = actor_.motion().poses[static_cast<std::size_t>(frame)];
  for (const Role left : {Role::kLeftHand, Role::kLeftFoot}) {
    canvas.DrawDot(studio.PixelOf(box, placement.Apply(pose[left])), kDot * box.height, kAccent);
  }
}

std::vector<int> SpreadFrames(const Shot& shot, int count) {
  const int shown = std::min(count, shot.Frames());
  std::vector<int> frames;
  for (int i = 0; i < shown; ++i) {
    const double part = shown > 1 ? static_cast<double>(i) / (shown - 1) : 0;
    frames.push_back(static_cast<int>(std::lround(part * (shot.Frames() - 1))));
  }
  return frames;
}

void DrawLegend(Canvas& canvas, double right, double baseline) {
  const std::string words = "left hand and foot";
  constexpr double kSize = 16;
  const double width = canvas.TextWidth(words, kSize);
  canvas.DrawText({right - width, baseline}, words, kSize, kSoftInk, width + 1);
  canvas.DrawDot({right - width - 10, baseline - 4.5}, 4, kAccent);
}

Result<bool> FilmClip(ClipActor actor, const FilmOptions& options, const std::filesystem::path& path,
                      Renderer& renderer) {
  const ClipFacts facts = FactsOf(actor.clip());
  const Shot shot(std::move(actor), options.from, kSmoothing);
  ViewBounds bounds;
  shot.Include(SpreadFrames(shot, kLookedAt), bounds);
  Studio studio(options.width, options.height, kDetail, bounds);
  const double rate = shot.actor().motion().rate_hz;
  const Box whole{0, 0, static_cast<double>(options.width), static_cast<double>(options.height)};
  const std::string words = FactsAsLine(facts);
  const auto draw = [&](int frame) {
    Canvas canvas(options.width, options.height);
    shot.Draw(canvas, whole, studio, renderer, frame);
    DrawTag(canvas, whole, fmt::format("{:.2f} s", shot.SecondsAt(frame)));
    DrawLegend(canvas, whole.width - 16, 29);
    DrawCaption(canvas, whole, facts.name, words);
    return canvas;
  };
  return EncodeFrames(path, shot.Frames(), rate, draw, options.watch);
}

}  // namespace etude
