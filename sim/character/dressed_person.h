#pragma once

#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/character.h"
#include "sim/character/outfit.h"
#include "sim/render/renderer.h"

namespace etude {

/// A dressed person who can be drawn in any pose: skin and clothes that follow the joints, painted in the space of the
/// standing body, so that patterns move with them.
class DressedPerson {
 public:
  explicit DressedPerson(const Outfit& outfit);

  /// The figure in a pose, filled as PosedFigure fills a body of other proportions; its shadow is that of its capsules.
  Figure At(const BodyPose& pose) const;

 private:
  Character character_;
  std::vector<Surface> still_;  ///< one per mesh: all of it that no pose changes
};

}  // namespace etude
