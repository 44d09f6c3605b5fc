#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/motion/body.h"
#include "sim/character/dressed_person.h"
#include "sim/render/renderer.h"
#include "sim/stage/furnish.h"

namespace etude {

/// What moves in the room besides the performer: a plant, a screen, a ball and a second person. All of it is a function
/// of time; each has dice of its own and appears at its own threshold of `scene`.
class Movers {
 public:
  Movers(std::uint64_t seed, double scene, double colour_share, const FurnishedRoom& room, const FreeFloor& free);

  /// What they look like at a moment, which may lie before the take. Labelled kClutter and kBystander.
  std::vector<Figure> At(double seconds) const;

  /// The second person's joints at that moment; nothing while nobody is there.
  std::optional<BodyPose> BystanderAt(double seconds) const;

 private:
  struct Leaf {
    glm::dvec3 tip{0};  ///< from the pot, at rest
    double phase = 0, rate_hz = 0;
  };
  struct Ball {
    glm::dvec3 middle{0};
    double reach = 0, radius = 0, height = 0, period_s = 1, phase = 0;
    Rgb8 colour{};
  };
  struct Bystander {
    DressedPerson person;
    BodyMotion motion;
    glm::dvec3 place{0};
    double size = 1, heading = 0, stroll_m = 0, period_s = 1, phase = 0;
  };

  Figure PlantAt(double seconds) const;
  Figure ScreenAt(double seconds) const;
  Figure BallAt(double seconds) const;

  std::uint64_t seed_;
  double scene_, colour_share_;
  Places places_;
  std::vector<Leaf> leaves_;
  Rgb8 leaf_colour_{};
  std::optional<Ball> ball_;
  std::optional<Bystander> bystander_;
};

}  // namespace etude
