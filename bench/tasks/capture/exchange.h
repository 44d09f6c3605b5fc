#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/capture/stages.h"
#include "engine/capture/recover_frames.h"
#include "io/drawing/sensor_sheet.h"

namespace etude {

/// Describes the studio to methods outside the program, which are told about takes of two cameras. Metres, Y up,
/// right-handed; a pose is sixty numbers (EncodePose). Pixels: u right, v down, (0, 0) is the top left corner of the
/// picture, the centre of its first pixel is (0.5, 0.5).
///
/// Setting:
///
///     {"rate_hz": 30, "image_width": 640, "image_height": 480,
///      "joints": ["hip_centre", …], "parents": [null, "hip_centre", …],
///      "strokes": [{"from": "left_hip", "to": "left_knee"}, …], "discs": ["left_foot", …]}
///
/// `strokes` are the thirteen limbs that the annotator marks with a line, `discs` the five ends marked with a point.
Payload DescribeStudio();

/// Makes the problem of a take: who is filmed, and per camera its calibration points (a place in the world and the
/// pixel clicked on for it), the empty stage, and a picture per frame; pictures are files that lie beside.
///
///     {"frames": 150, "limb_lengths_m": {"foot": 0.18, "shank": 0.42, …},
///      "cameras": [{"calibration": [{"world_m": [x, y, z], "pixel": [u, v]}, …],
///                   "background": "camera-1-background.png",
///                   "pictures": ["camera-1-0000.png", …]}, …],
///      "marks": {"hue": [[{"strokes": [[u, v, u, v], null, …], "discs": [[u, v], null, …]}, …], […]], "hue-gated": …}}
///
/// `marks`, for methods that want no vision of their own: what the annotator drew on each camera's frames, as built-in
/// methods see it. It is drawn on the person that a segmenter has cut out, so that what the segmenter lost is not
/// marked; by the segmenter's name, then [camera][frame]; null is a frame that the annotator did not see, a mark that
/// is missing or could not be read. A stroke goes from its limb's `from` to its `to`.
///
/// The same marks lie beside as COCO keypoints, `marks-hue-camera-1.coco.json` and so on (coco.h), and the calibration
/// points as `etude calibrate` reads them, `calibration-points.yaml`.
///
/// Fails when there is no renderer, and for takes of more than kMostPictures pictures.
Result<Payload> MakeCaptureProblem(const StudioOptions& options, const WorldKey& key, CaptureStages& stages);
constexpr std::size_t kMostPictures = 1200;

/// Makes the truth of a take: the poses, themselves a perfect answer; beside it `truth.bvh`, `truth.trc` and
/// `truth.csv` (the same for other programs), `camera-1.yaml`… (OpenCV's calibration file), `calibration.toml` (all of
/// them as Pose2Sim's), and per frame `camera-1-0000.exr`: `label`, `Z` (depth along the viewing axis, metres), `N.X`,
/// `N.Y`, `N.Z` (normals in the world), and `R`, `G`, `B`, linear light as a camera would see it that has this one's
/// lens and clock, and no other faults. Further `Z_measured.v1` and `.v2`: what the first and the second Kinect's depth
/// camera would measure in its place (sim/depth_camera); infinity where nothing.
///
///     {"poses": [[sixty numbers], …], "labels": {"background": 0, "shadow": 1, "trunk": 2, …}}
Result<Payload> MakeCaptureTruth(const StudioOptions& options, const WorldKey& key, CaptureStages& stages);

/// Two cameras at the take's liveliest frame: as the scenario has them, with labels, depth and the annotator's marks;
/// then every effect of a camera at three strengths, whatever else the scenario has left as it is. The true skeleton at
/// that time is drawn over what clocks and shutters do. Fails when there is no renderer.
Result<SensorSheet> MakeCaptureSheet(const StudioOptions& options, const WorldKey& key, CaptureStages& stages);

/// The answer of a method outside, one entry per frame, null where it has no pose:
///
///     {"poses": [[sixty numbers], null, …]}
///
/// Scored like a built-in method: where there is no pose the last one is shown, so that it counts in every joint
/// error; `frames_recovered` is the share of frames with a pose. What only a built-in method's stages can tell is
/// missing.
using CaptureAnswer = std::vector<std::optional<BodyPose>>;
Result<CaptureAnswer> ReadCaptureAnswer(const Json& answer, std::size_t frames);

/// Records a built-in method's motion with its masks, as CaptureExtras. `name` is its BVH clip's. The frames numbered
/// `moments`, counted from 1, keep their marks and the skeleton before inverse kinematics, too; frames that there are
/// not are ignored.
Recording MakeRecording(const CaptureWorld& world, const Take& take, const Observation& observation,
                        const CaptureBody& body, const std::vector<RecoveredFrame>& frames, const std::string& name,
                        std::span<const double> moments);

/// Records what an answer alone can show: nothing is cut out, and no joint of its BVH clip turns.
Recording MakeRecording(const CaptureWorld& world, const std::vector<BodyPose>& poses);

}  // namespace etude
