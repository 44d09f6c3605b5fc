#pragma once

#include <optional>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/character.h"
#include "sim/render/scene.h"

namespace etude {

/// The build of a person: the flesh around the joints, which are the clip's.
enum class Build { kMedium, kSlim, kStout, kChild, kTall };

/// The build, the colours and the clothes of one person.
struct Outfit {
  Build build = Build::kMedium;
  SurfacePaint skin, hair, top, bottom, shoes;
  double sleeve_cm = 24;  ///< along the arm (30 + 25 to the wrist)
  double leg_cm = 78;     ///< of trousers, along the leg (42 + 42 to the ankle)
  bool is_skirt = false;  ///< in place of trousers
  double skirt_cm = 40;   ///< from the hips down
  bool has_long_hair = false;
  /// A suit from the crown to the toes in place of all that: every part of the body in a plain colour of its own.
  std::optional<PartColours> suit = {};
};

/// A dressed person who can be drawn in any pose: skin and clothes that follow the joints, painted in the space of the
/// standing body, so that patterns move with them.
class DressedPerson {
 public:
  explicit DressedPerson(const Outfit& outfit);

  /// Returns the figure in a pose, filled as PosedFigure fills a body of other proportions; its shadow is that of its
  /// capsules.
  Figure At(const BodyPose& pose) const;

 private:
  Character character_;
  std::vector<Surface> still_;  ///< one per mesh: all of it that no pose changes
};

}  // namespace etude
