#include "reports/clips/clip_actor.h"

#include "engine/retargeting/proportions.h"
#include "sim/body/shape.h"
#include "sim/character/characters.h"
#include "sim/character/posed.h"
#include "sim/choreography/canonical_body.h"

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

}  // namespace

Result<ClipActor> ClipActor::Make(OpenedClip clip, std::optional<ActorKind> kind) {
  const bool has_own = clip.source.character != nullptr;
  if (!kind) {
    const bool is_builtin = clip.source.format == ClipFormat::kBuiltin;
    kind = has_own ? ActorKind::kOwn : is_builtin ? ActorKind::kBear : ActorKind::kMannequin;
  }
  if (*kind == ActorKind::kOwn && !has_own) {
    return Fail({clip.source.source, 0, 0}, "has no figure of its own; allowed: bear, mannequin, body");
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
  return PosedFigure(*character_, pose);
}

}  // namespace etude
