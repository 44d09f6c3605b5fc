#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bench/tasks/capture/options.h"
#include "engine/cameras/camera.h"
#include "engine/capture/measure_frames.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/motion/body.h"
#include "engine/motion/rest_body.h"
#include "io/clips/clip_library.h"
#include "sim/character/posed.h"
#include "sim/random/stream.h"
#include "sim/render/scene.h"
#include "sim/stage/stage.h"

namespace etude {

/// The limb lengths of a person, in paper B's form and joint by joint.
struct PersonalLimbs {
  LimbLengths lengths;
  RestBody body;
};

/// The meshes in a clip's file, drawn instead of the stage's performer. Their motion begins at frame `first` of the
/// clip and is moved to the place of the take.
struct OwnFigure {
  std::shared_ptr<const RecordedFigure> figure;
  std::size_t first = 0;
  FloorMove move;
};

/// The truth of one take: performer, motion, cameras and light.
struct CaptureWorld {
  /// The performer's poses at 30 Hz, around the floor's origin, facing +Z in the middle frame.
  std::vector<BodyPose> truth;
  PersonalLimbs person;            ///< the performer's true limbs
  PersonalLimbs measured;          ///< the limb lengths as measured beforehand, as in paper B
  std::array<Rgb8, 16> colours{};  ///< the performer's colours, indexed by Part
  std::optional<OwnFigure> own;    ///< a figure that is drawn instead of the stage's people
  glm::dvec3 middle{0};            ///< the expected position of the performer on the floor
  std::vector<Camera> cameras;     ///< at least two, each with its lens
  std::vector<bool> in_view;       ///< for each frame, true if two cameras or more see the whole body
  Room room;                       ///< the empty room; background pictures use its `brightness` unchanged
  StageOptions stage_options;
  StagedRoom stage;                ///< the room and people that `scene` adds
  std::vector<double> brightness;  ///< brightness of the lamp in each frame
};

/// The person who will be filmed, and the number of frames.
struct FilmedPerson {
  std::span<const BodyPose> poses;  ///< expected poses: cameras and furniture are set up around them
  RestBody body;
  LimbLengths lengths;
  std::size_t frames = 0;
};

/// Makes the studio of `key` without a performer: `truth` and `in_view` are empty.
CaptureWorld MakeStudio(const StudioOptions& options, const FilmedPerson& booking, const WorldKey& key);

/// Makes the world of `key`. The window of the clip begins at a random frame. A few random windows are tried. The first
/// one that keeps the performer within 1.2 m of the middle along X and Z, where the cameras see the whole body, is
/// taken. If none does, the window that exceeds this distance least is taken. Clips that loop are repeated; other clips
/// that are shorter than the window are used whole. In a secret world the clip is disguised
/// (bench/tasks/base/disguise.h), unless the mesh of its own file is drawn.
CaptureWorld MakeCaptureWorld(const StudioOptions& options, const LibraryClip& clip, const WorldKey& key);

/// Returns the lens distortion of a camera that has these effects.
Distortion LensOf(const CameraEffects& effects, const Camera& camera, std::size_t index, const WorldKey& key);

/// Returns the measurements of a frame that exact marks and exact cameras would give.
FrameMeasurement TrueMeasurement(const BodyPose& truth);

}  // namespace etude
