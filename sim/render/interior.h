#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "sim/render/surface_paint.h"

namespace etude {

/// A box that stands in the room all the time, turned about the vertical; its pixels are kFurniture. As
/// sim/body/cuboid.h has it.
struct FurnitureBox {
  glm::dvec3 centre{0};     ///< metres
  glm::dvec3 half_size{0};  ///< along its own axes
  double heading = 0;       ///< radians: its own +Z points to (sin heading, 0, cos heading)
  SurfacePaint paint;
};

/// A picture or a window: a rectangle painted on a wall; its pixels are the wall's.
struct WallPicture {
  enum class Wall { kBack, kLeft, kRight };  ///< z = low.z, x = low.x, x = high.x
  Wall wall = Wall::kBack;
  glm::dvec2 centre{0};     ///< metres: along the wall (x, or z of a side wall), above the floor
  glm::dvec2 half_size{0};  ///< metres, its frame included
  SurfacePaint paint;
  Rgb8 frame{};
  double glow = 0;  ///< light of its own: 1 = a window at noon shows its paint whatever the lamps do
};

/// The lights of an interior, in shares of the studio's lamp and ambient light. Linear RGB.
struct Lights {
  glm::dvec3 key{-1.8, 2.9, 4.0};  ///< where the lamp that throws shadows hangs, metres
  glm::dvec3 key_colour{1};
  glm::dvec3 ambient_colour{1};
  glm::dvec3 fill{1, 0, 0};  ///< towards a wide, weak light without shadows: unit
  glm::dvec3 fill_colour{0};
  glm::dvec3 window{0};  ///< the middle of the window, metres
  glm::dvec3 window_colour{0};
};

/// The most that one interior holds; more are not drawn.
constexpr std::size_t kMostFurnitureBoxes = 48;
constexpr std::size_t kMostWallPictures = 8;

/// A furnished room: a closed box, painted, with what stands in it. Walls are seen from inside only, so a camera may
/// stand behind one.
struct Interior {
  glm::dvec3 low{-4, 0, -2.5};  ///< its corners, metres
  glm::dvec3 high{4, 3.3, 5};
  SurfacePaint floor, wall, ceiling;
  Rgb8 skirting{};
  double studio = 0;  ///< how much of the walls and the floor still is the studio's paint: 1 = all
  glm::dvec4 rug{0};  ///< x, z of its middle, half its size along x and z; 0: none
  SurfacePaint rug_paint;
  Lights lights;
  std::vector<FurnitureBox> furniture;
  std::vector<WallPicture> pictures;
};

bool operator==(const Lights&, const Lights&);
bool operator==(const Interior&, const Interior&);

}  // namespace etude
