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

/// The limb lengths of a person: as paper B counts them, and joint by joint.
struct PersonalLimbs {
  LimbLengths lengths;
  RestBody body;
};

/// The figure that a clip brings, from a frame of that clip on and moved to where the take is.
struct OwnFigure {
  std::shared_ptr<const RecordedFigure> figure;
  std::size_t first = 0;
  FloorMove move;
};

/// The truth of one take: who moves how in front of which cameras under which light.
struct CaptureWorld {
  std::vector<BodyPose> truth;     ///< 30 Hz, about the floor's origin, facing +Z in its middle frame
  PersonalLimbs person;            ///< who moves
  PersonalLimbs measured;          ///< the same as it was measured beforehand, as paper B does
  std::array<Rgb8, 16> colours{};  ///< of the performer, by Part
  std::optional<OwnFigure> own;    ///< who is drawn in place of the stage's people
  glm::dvec3 middle{0};            ///< on the floor: where the performer is expected
  std::vector<Camera> cameras;     ///< two or more, each with its lens
  std::vector<bool> in_view;       ///< of each frame: whether two cameras have the whole body in their pictures
  Room room;                       ///< its brightness is that of the background pictures; of the studio alone
  StageOptions stage_options;      ///< what `stage` was made of
  StagedRoom stage;                ///< the room and people that `scene` adds
  std::vector<double> brightness;  ///< of each frame
};

/// The person to be filmed, and for how long.
struct Booking {
  std::span<const BodyPose> poses;  ///< about where they will be: cameras and furniture are set up around
  RestBody body;
  LimbLengths lengths;
  std::size_t frames = 0;
};

/// The studio of `key`, with nobody in it yet: `truth` and `in_view` are empty.
CaptureWorld MakeStudio(const StudioOptions& options, const Booking& booking, const WorldKey& key);

/// The world of `key`. The window of the clip begins by dice; among a few throws the first is taken that
/// keeps the performer within 1.2 m of the middle, where both cameras see the whole body, else the one
/// that strays least. Moves that loop are repeated; other clips shorter than the window are taken whole. In a secret
/// world the clip is disguised (bench/tasks/base/disguise.h), unless it brings its own figure.
CaptureWorld MakeCaptureWorld(const StudioOptions& options, const LibraryClip& clip, const WorldKey& key);

/// The lens that a camera of the world has under those effects.
Distortion LensOf(const CameraEffects& effects, const Camera& camera, std::size_t index, const WorldKey& key);

/// The measurements that faultless marks and cameras would give of a frame.
FrameMeasurement TrueMeasurement(const BodyPose& truth);

}  // namespace etude
