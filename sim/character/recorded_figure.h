#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/character.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/to_body.h"
#include "sim/render/renderer.h"

namespace etude {

/// The figure that a file brings along with its clip, moving as recorded: its meshes and textures on its own skeleton.
class RecordedFigure {
 public:
  /// Of a clip with the character's skeleton, which `map` has understood and `body` has put into the world.
  RecordedFigure(std::shared_ptr<const Character> character, Clip clip, const JointMap& map,
                 const BodyConversion& body);

  /// At a frame of the body's motion, also between frames (`SampleFrame`), and moved along the floor.
  Figure At(double frame, const FloorMove& move = {}) const;

 private:
  std::shared_ptr<const Character> character_;
  Clip clip_;
  double first_ = 0;             // the clip's frame that is the motion's first one
  double frames_per_frame_ = 1;  // of the clip, for one of the motion
  glm::dmat4 to_world_{1};
  std::vector<Surface> still_;  // one per mesh: all of it that no pose changes
};

}  // namespace etude
