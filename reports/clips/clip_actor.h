#pragma once

#include <memory>
#include <optional>

#include "bench/clips/open_clip.h"
#include "engine/motion/body.h"
#include "engine/motion/character.h"
#include "sim/character/posed.h"
#include "sim/render/scene.h"

namespace etude {

/// Who is seen performing a clip.
enum class ActorKind {
  kOwn,        ///< the file's own meshes
  kMannequin,  ///< in the actor's own proportions
  kBear,       ///< in the bear's
  kBody,       ///< capsules around the joints; the left side has another colour than the right one
};

/// A clip with the figure that performs it, frame by frame at the body's rate.
class ClipActor {
 public:
  /// Without a kind: the file's own figure, if it has one; the bear for built-in clips; else the mannequin. Refused:
  /// the own figure of a file without meshes.
  static Result<ClipActor> Make(OpenedClip clip, std::optional<ActorKind> kind);

  const OpenedClip& clip() const { return clip_; }
  /// Of whom is seen: the bear's joints are not where the actor's are.
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

}  // namespace etude
