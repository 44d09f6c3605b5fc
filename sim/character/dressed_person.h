#pragma once

#include <optional>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/character.h"
#include "sim/render/scene.h"

namespace etude {

/// The build of a person: the shape around the joints. The positions of the joints come from the clip.
enum class Build { kMedium, kSlim, kStout, kChild, kTall };

/// The build, the colours and the clothes of one person.
struct Outfit {
  Build build = Build::kMedium;
  SurfacePaint skin, hair, top, bottom, shoes;
  double sleeve_cm = 24;  ///< length of the sleeves along the arm (the elbow is at 30 cm, the wrist at 55 cm)
  double leg_cm = 78;     ///< length of the trousers along the leg (the knee is at 42 cm, the ankle at 84 cm)
  bool is_skirt = false;  ///< a skirt instead of trousers
  double skirt_cm = 40;   ///< length of the skirt from the hips down
  bool has_long_hair = false;
  /// If set, a suit from head to toe replaces the clothes above: every part of the body has one plain colour.
  std::optional<PartColours> suit = {};
};

/// A dressed person who can be drawn in any pose. Skin and clothes follow the joints. Patterns are defined on the
/// standing body, and therefore move with the skin and the clothes.
class DressedPerson {
 public:
  explicit DressedPerson(const Outfit& outfit);

  /// Returns the figure in a pose, scaled to the body's proportions (see PosedFigure). `BodyCapsules(pose)` casts the
  /// figure's shadow.
  Figure At(const BodyPose& pose) const;

 private:
  Character character_;
  std::vector<Surface> still_;  ///< one surface per mesh, with all data that do not depend on the pose
};

}  // namespace etude
