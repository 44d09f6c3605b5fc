#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "sim/character/dressed_person.h"
#include "sim/render/scene.h"
#include "sim/stage/furnish.h"
#include "sim/stage/wardrobe.h"

namespace etude {

/// The moving objects in the room besides the performer: a plant, a screen, a ball and a second person. Each object's
/// motion is a function of time. Each object has its own random numbers and its own threshold of `scene`.
class Movers {
 public:
  Movers(std::uint64_t seed, double scene, double colour_share, const FurnishedRoom& room, const FreeFloor& free);

  /// Returns the figures at a time, which may be before the take. The figures are labelled kClutter and kBystander.
  std::vector<Figure> At(double seconds) const;

  /// Returns the second person's joints at a time; nullopt if the room has no second person.
  std::optional<BodyPose> BystanderAt(double seconds) const;

 private:
  struct Leaf {
    glm::dvec3 tip{0};  ///< position relative to the pot, without sway
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
  MoverPositions places_;
  std::vector<Leaf> leaves_;
  Rgb8 leaf_colour_{};
  std::optional<Ball> ball_;
  std::optional<Bystander> bystander_;
};

/// The options of a stage.
struct StageOptions {
  std::uint64_t seed = 1;  ///< seed of all random numbers; `scene` does not change these numbers
  /// 0 = the studio: an empty, bluish room and a performer of capsules in warm colours. 1 = a furnished room with
  /// moving people and objects; the performer's clothes and the objects have similar colours (table in README.md).
  double scene = 0;
  Wardrobe wardrobe = Wardrobe::kStudio;
};

/// The room around a performer: furniture, moving objects, the performer's clothes, and the lighting. At scene 0 it is
/// the empty studio.
class StagedRoom {
 public:
  StagedRoom() = default;
  /// Makes a room for a performer who moves like `poses` in front of `cameras`. No furniture stands on the floor that
  /// the performer uses.
  StagedRoom(const StageOptions& options, std::span<const BodyPose> poses, std::span<const Camera> cameras);

  /// Returns the interior, or null for the studio. The interior belongs to this object.
  const Interior* interior() const { return furnished_ ? &furnished_->interior : nullptr; }
  bool IsPerformerDressed() const { return performer_.has_value(); }
  /// Returns the dressed performer; in scene 0, which has no clothes, capsules in the `studio` colours.
  Figure PerformerAt(const BodyPose& pose, const PartColours& studio) const;
  /// Returns the moving objects at `seconds` after the take's start; negative times are before the start.
  std::vector<Figure> MoversAt(double seconds) const;
  /// Returns the second person's joints; nullopt if the room has no second person.
  std::optional<BodyPose> BystanderAt(double seconds) const;
  /// Returns the factor by which the 100 Hz flicker of mains-powered lamps changes the light of a picture taken at this
  /// time.
  double FlickerAt(double seconds) const;

  /// The time of the background picture, seconds. It is before the take, when all moving objects are at other
  /// positions.
  static constexpr double kBackgroundSeconds = -6.3;

 private:
  std::optional<FurnishedRoom> furnished_;
  std::optional<Movers> movers_;
  std::optional<DressedPerson> performer_;
  bool is_hooded_ = false;
  double flicker_ = 0, flicker_phase_ = 0;
};

/// Returns the share of everyday colours at this value of `scene`; the other colours are the studio's.
double ColourShare(double scene);

}  // namespace etude
