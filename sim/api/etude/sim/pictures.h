#pragma once

#include <etude/cameras.h>
#include <etude/motion.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace etude::sim {

struct StudioOptions {
  /// The furnishing of the room, 0 to 1; 0: a bare studio and a person of capsules in warm colours, 1: a room that
  /// people live in, and a dressed person.
  double scene = 0;
  std::uint64_t seed = 1;  ///< of the room, its things and the person's clothes
};

struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> colour;  ///< three bytes a pixel: red, green, blue; row after row from the top
  std::vector<std::uint8_t> person;  ///< one byte a pixel: 1 where it shows the person, else 0
};

/// Returns two cameras side by side, as people set them up before a body that moves so: 640 × 480 pixels, their axes
/// about parallel, some centimetres from where they should stand by the dice of `seed`, the motion in both pictures as
/// far as lenses allow. Throws BadInput for a baseline that is not 0.05 to 2 m, and a motion without frames.
ETUDE_API std::vector<engine::Camera> StereoCameras(const engine::Motion& motion, double baseline_m = 0.6,
                                                    std::uint64_t seed = 1);

/// A room in which a person moves before cameras, all of them faultless and taking each picture at once. It looks the
/// same whenever it is drawn. One thread at a time may draw, with whichever studio.
class ETUDE_API Studio {
 public:
  /// Throws BadInput for a motion without frames, no camera, pictures of more than 4096 pixels a side, a lens that
  /// distorts, a scene out of range, and where nothing can be drawn (OSMesa or EGL is opened when it is needed).
  Studio(const engine::Motion& motion, std::span<const engine::Camera> cameras, const StudioOptions& options = {});
  Studio(Studio&&) noexcept;
  Studio& operator=(Studio&&) noexcept;
  ~Studio();

  /// Takes the picture of a frame of the motion. Throws BadInput for a camera or frame that there is not.
  Picture Shoot(std::size_t camera, std::size_t frame) const;
  /// Takes a picture before the person came in. What moves by itself stands elsewhere then.
  Picture ShootEmpty(std::size_t camera) const;

 private:
  struct Room;
  std::unique_ptr<Room> room_;
};

}  // namespace etude::sim
