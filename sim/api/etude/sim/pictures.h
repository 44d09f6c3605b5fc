#pragma once

#include <etude/cameras.h>
#include <etude/motion.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/image.h"

namespace etude::sim {

struct StudioOptions {
  /// The amount of furniture, 0 to 1. At 0 the room is a bare studio with a person made of capsules in warm colours; at
  /// 1 it is a furnished room with a dressed person.
  double scene = 0;
  std::uint64_t seed = 1;  ///< seed of the room, the objects in the room and the person's clothes
};

struct Picture {
  ColourImage colour;
  Mask person;  ///< mask that is 1 where the person is visible
};

/// Returns two cameras side by side, placed as a person would place them in front of a body that performs this motion:
/// 640 × 480 pixels, nearly parallel axes, a few centimetres from the exact positions (random, by `seed`). The whole
/// motion is visible to both cameras as far as the lenses allow. Throws BadInput for a baseline that is not 0.05 to 2
/// m, and for a motion without frames.
ETUDE_API std::vector<NamedCamera> StereoCameras(const BodyMotion& motion, double baseline_m = 0.6,
                                                 std::uint64_t seed = 1);

/// A room in which a person moves in front of ideal cameras, which take each picture in an instant and without errors.
/// The same arguments always give a picture with the same bytes. Only one thread at a time may draw, even with
/// different studios.
class ETUDE_API Studio {
 public:
  /// Throws BadInput for a motion without frames, no cameras, pictures of more than 4096 pixels a side, a lens with
  /// distortion, or a scene out of range. Also throws if drawing is impossible: OSMesa or EGL is loaded on first use.
  Studio(const BodyMotion& motion, std::span<const NamedCamera> cameras, const StudioOptions& options = {});
  Studio(Studio&&) noexcept;
  Studio& operator=(Studio&&) noexcept;
  ~Studio();

  /// Takes the picture of a frame of the motion. Throws BadInput if the camera or the frame does not exist.
  Picture Shoot(std::size_t camera, std::size_t frame) const;
  /// Takes a picture of the room before the person enters it. The room's moving objects have other positions than in
  /// `Shoot`.
  Picture ShootEmpty(std::size_t camera) const;

 private:
  struct Room;
  std::unique_ptr<Room> room_;
};

}  // namespace etude::sim
