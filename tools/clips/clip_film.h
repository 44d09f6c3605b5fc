#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/character.h"
#include "io/clips/open_clip.h"
#include "io/drawing/canvas.h"
#include "io/drawing/film.h"
#include "io/drawing/studio.h"
#include "sim/character/posed.h"
#include "sim/render/renderer.h"

namespace etude {

/// The figure that is seen performing a clip.
enum class ActorKind {
  kOwn,        ///< the file's own meshes
  kMannequin,  ///< in the actor's own proportions
  kBear,       ///< in the bear's
  kBody,       ///< capsules around the joints; the left side has another colour than the right one
};

/// A clip with the figure that performs it, frame by frame at the body's rate.
class ClipActor {
 public:
  /// Chooses, without a kind, the file's own figure if it has one, the bear for built-in clips, else the mannequin.
  /// Refused: the own figure of a file without meshes.
  static Result<ClipActor> Make(OpenedClip clip, std::optional<ActorKind> kind);

  const OpenedClip& clip() const { return clip_; }
  /// Gives the motion of the figure that is seen: the bear's joints are not where the actor's are.
  const BodyMotion& motion() const { return motion_; }
  Figure FigureAt(std::size_t frame) const;

 private:
  ClipActor(OpenedClip clip, ActorKind kind);

  OpenedClip clip_;
  ActorKind kind_;
  BodyMotion motion_;
  std::optional<RecordedFigure> own_;           // of kOwn
  std::shared_ptr<const Character> character_;  // of kMannequin, kBear
};

/// The side that a clip is seen from: as its first frame faces the camera, turned by 40 degrees, or from the side.
enum class Viewpoint { kFront, kThreeQuarter, kSide };

/// A clip before the camera: its figure, and where it is put in every frame.
class Shot {
 public:
  /// Puts the clip before the camera; `smoothing` is CameraPath's: 0 keeps a walker in the middle of every picture.
  Shot(ClipActor actor, Viewpoint from, int smoothing);

  const ClipActor& actor() const { return actor_; }
  int Frames() const { return static_cast<int>(placements_.size()); }
  double SecondsAt(int frame) const { return frame / actor_.motion().rate_hz; }

  const FloorMove& PlacementAt(int frame) const { return placements_[static_cast<std::size_t>(frame)]; }
  Figure PlacedFigure(int frame) const;

  /// Widens `bounds` so that it holds these frames' figures.
  void Include(const std::vector<int>& frames, ViewBounds& bounds) const;
  /// Draws a frame, with a dot on the left hand and the left foot.
  void Draw(Canvas& canvas, const Box& box, Studio& studio, Renderer& renderer, int frame) const;

 private:
  ClipActor actor_;
  std::vector<FloorMove> placements_;
};

/// Gives `count` frames spread evenly over a shot, first and last among them; fewer when it has fewer.
std::vector<int> SpreadFrames(const Shot& shot, int count);

/// Draws the legend of Shot::Draw's dots; `right` is where the words end.
void DrawLegend(Canvas& canvas, double right, double baseline);

struct FilmOptions {
  Viewpoint from = Viewpoint::kThreeQuarter;
  int width = 720;  ///< even numbers
  int height = 720;
  FilmWatch watch = {};  ///< stopped early, it leaves no file
};

/// Films a clip from its first to its last frame as an MP4; the camera follows. False when it was stopped.
Result<bool> FilmClip(ClipActor actor, const FilmOptions& options, const std::filesystem::path& path,
                      Renderer& renderer);

}  // namespace etude
