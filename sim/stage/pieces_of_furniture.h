#pragma once

#include <vector>

#include "sim/random/stream.h"
#include "sim/render/interior.h"

namespace etude {

// Pieces of furniture, made of boxes. `place` is on the floor, in the middle of the piece's back (of what stands free:
// of the piece); `heading` is where it looks. Sizes, colours and details by dice; colours lie `share` of the way from
// the studio's to those of everyday things. A piece always takes as many numbers.

std::vector<FurnitureBox> MakeCupboard(RandomStream& random, double share, const glm::dvec3& place, double heading);
std::vector<FurnitureBox> MakeShelf(RandomStream& random, double share, const glm::dvec3& place, double heading);
std::vector<FurnitureBox> MakeSofa(RandomStream& random, double share, const glm::dvec3& place, double heading);
std::vector<FurnitureBox> MakeTable(RandomStream& random, double share, const glm::dvec3& place, double heading);
/// A low cabinet and a screen on it; the screen comes last.
std::vector<FurnitureBox> MakeScreen(RandomStream& random, double share, const glm::dvec3& place, double heading);
/// One box: the leaves move (movers.h).
std::vector<FurnitureBox> MakePlantPot(RandomStream& random, double share, const glm::dvec3& place, double heading);
/// Boxes on one another.
std::vector<FurnitureBox> MakePile(RandomStream& random, double share, const glm::dvec3& place, double heading);
std::vector<FurnitureBox> MakeChair(RandomStream& random, double share, const glm::dvec3& place, double heading);
std::vector<FurnitureBox> MakeCrate(RandomStream& random, double share, const glm::dvec3& place, double heading);

}  // namespace etude
