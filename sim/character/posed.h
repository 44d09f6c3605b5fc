#pragma once

#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/character.h"
#include "sim/render/renderer.h"

namespace etude {

/// A character in a pose of its own skeleton, ready to be drawn: metres, Y up, moved as `to_world` says (of
/// a file's figure: the unit, axes and floor that ToBodyMotion has found).
Figure PosedFigure(const Character& character, const LocalPose& pose, const glm::dmat4& to_world = glm::dmat4(1));

/// A character bound to BodySkeleton(StandingPose()), at a body's pose. A body of other proportions is filled too: each
/// part is as large as the limb that it clothes, hips and chest as wide as their joints are apart.
Figure PosedFigure(const Character& character, const BodyPose& pose);

/// The joints of such a character in `pose`, their axes as much longer or shorter as its limbs are.
std::vector<GlobalTransform> FilledGlobals(const Character& character, const BodyPose& pose);

/// What each triangle shows: the part whose joints move its corners most.
std::vector<Part> PartsOfTriangles(const Skeleton& skeleton, const SkinnedMesh& mesh);

}  // namespace etude
