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

/// The figure that performs a clip in the picture.
enum class ActorKind {
  kOwn,        ///< the file's own meshes
  kMannequin,  ///< a mannequin with the performer's proportions
  kBear,       ///< the bear, with its own proportions
  kBody,       ///< capsules around the joints; left and right have different colours
};

/// A clip, and the figure that performs the clip, frame by frame at the rate of the body motion.
class ClipActor {
 public:
  /// Makes an actor. If no kind is given, the actor is the file's own figure if the file has one, the bear for built-in
  /// clips, and the mannequin for all other clips. Fails if `kOwn` is requested for a file without meshes.
  static Result<ClipActor> Make(OpenedClip clip, std::optional<ActorKind> kind);

  const OpenedClip& clip() const { return clip_; }
  /// Returns the motion of the visible figure. Only the bear's motion differs from the clip's body motion, because the
  /// bear's joints have other positions.
  const BodyMotion& motion() const { return motion_; }
  Figure FigureAt(std::size_t frame) const;

 private:
  ClipActor(OpenedClip clip, ActorKind kind);

  OpenedClip clip_;
  ActorKind kind_;
  BodyMotion motion_;
  std::optional<RecordedFigure> own_;           // the file's own figure, for kOwn
  std::shared_ptr<const Character> character_;  // the drawn figure, for kMannequin and kBear
};

/// The direction from which the camera sees the body, relative to the body's heading in the first frame: from the
/// front, 40 degrees to the side of the front, or from the side.
enum class Viewpoint { kFront, kThreeQuarter, kSide };

/// A clip in front of the camera: the figure, and the figure's position in every frame.
class Shot {
 public:
  /// Places the clip in front of the camera. `smoothing` is an argument of CameraPath; 0 keeps a walking body in the
  /// middle of every picture.
  Shot(ClipActor actor, Viewpoint from, int smoothing);

  const ClipActor& actor() const { return actor_; }
  int Frames() const { return static_cast<int>(placements_.size()); }
  double SecondsAt(int frame) const { return frame / actor_.motion().rate_hz; }

  const FloorMove& PlacementAt(int frame) const { return placements_[static_cast<std::size_t>(frame)]; }
  Figure PlacedFigure(int frame) const;

  /// Widens `bounds` so that the bounds contain the figure in each of `frames`.
  void Include(const std::vector<int>& frames, ViewBounds& bounds) const;
  /// Draws a frame, with a dot on the left hand and the left foot.
  void Draw(Canvas& canvas, const Box& box, Studio& studio, Renderer& renderer, int frame) const;

 private:
  ClipActor actor_;
  std::vector<FloorMove> placements_;
};

/// Returns `count` frames spread evenly over a shot, including the first and the last; all frames if the shot has fewer
/// than `count`.
std::vector<int> SpreadFrames(const Shot& shot, int count);

/// Draws the legend of the dots of Shot::Draw; the text ends at x = `right`.
void DrawLegend(Canvas& canvas, double right, double baseline);

struct FilmOptions {
  Viewpoint from = Viewpoint::kThreeQuarter;
  int width = 720;  ///< pixels; width and height must be even
  int height = 720;
  FilmWatch watch = {};  ///< observes the film and can stop it; then no file remains
};

/// Writes an MP4 of a whole clip; the camera follows the body. Returns false if the film was stopped.
Result<bool> FilmClip(ClipActor actor, const FilmOptions& options, const std::filesystem::path& path,
                      Renderer& renderer);

}  // namespace etude
