#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/capture/stages.h"
#include "engine/capture/recover_frames.h"

namespace etude {

/// Describes the studio to outside methods, which are asked about takes of two cameras. Metres, Y up, right-handed; a
/// pose is sixty numbers (EncodePose). Pixels: u right, v down; (0, 0) is the top left corner of the picture, and the
/// centre of its first pixel is (0.5, 0.5).
///
/// Setting:
///
///     {"rate_hz": 30, "image_width": 640, "image_height": 480,
///      "joints": ["hip_centre", …], "parents": [null, "hip_centre", …],
///      "strokes": [{"from": "left_hip", "to": "left_knee"}, …], "discs": ["left_foot", …]}
///
/// `strokes` are the thirteen limbs that the annotator marks with a line, `discs` the five ends marked with a point.
Payload DescribeStudio();

/// Makes the problem of a take: the limb lengths of the performer, and per camera its calibration points (a position in
/// the world and the pixel clicked for it), the empty stage, and a picture per frame. Pictures are separate files.
///
///     {"frames": 150, "limb_lengths_m": {"foot": 0.18, "shank": 0.42, …},
///      "cameras": [{"calibration": [{"world_m": [x, y, z], "pixel": [u, v]}, …],
///                   "background": "camera-1-background.png",
///                   "pictures": ["camera-1-0000.png", …]}, …],
///      "marks": {"hue": [[{"strokes": [[u, v, u, v], null, …], "discs": [[u, v], null, …]}, …], […]], "hue-gated": …}}
///
/// `marks` are for methods without vision of their own: what the annotator drew on each camera's frames, as built-in
/// methods see it. The annotator draws on the person that a segmenter has cut out, so parts lost by the segmenter are
/// not marked. Marks are listed by segmenter, then [camera][frame]; null is a frame that the annotator was not shown,
/// or a mark that is missing or unreadable. A stroke goes from its limb's `from` to its `to`.
///
/// The same marks are also given as COCO keypoints, `marks-hue-camera-1.coco.json` and so on (coco.h), and the
/// calibration points in the format of `etude calibrate`, `calibration-points.yaml`.
///
/// Fails without a renderer, and for takes of more than kMaxPictures pictures.
Result<Payload> MakeCaptureProblem(const StudioOptions& options, const WorldKey& key, CaptureStages& stages);
constexpr std::size_t kMaxPictures = 1200;

/// Makes the truth of a take: the poses; as an answer they would be perfect. Files: `truth.bvh`, `truth.trc` and
/// `truth.csv` hold the same for other programs; `camera-1.yaml`… are OpenCV calibration files, `calibration.toml` all
/// of them in Pose2Sim's format.
///
///     {"poses": [[sixty numbers], …], "labels": {"background": 0, "shadow": 1, "trunk": 2, …}}
Result<Payload> MakeCaptureTruth(CaptureStages& stages);

/// Makes the pictures of the truth and passes them to `keep`. Per frame `camera-1-0000.exr` holds `label`, `Z` (depth
/// along the viewing axis, metres), `N.X`, `N.Y`, `N.Z` (normals in the world), and `R`, `G`, `B`, the linear light of
/// a camera with this lens and clock but no other faults. `Z_measured.v1` and `.v2` are what the depth cameras of the
/// first and second Kinect would measure from the same place (sim/depth_camera); infinity where they measure nothing.
/// Fails without a renderer.
Result<void> MakeCapturePictures(const StudioOptions& options, const WorldKey& key, CaptureStages& stages,
                                 const AttachmentSink& keep);

/// The answer of an outside method, one entry per frame, null without a pose:
///
///     {"poses": [[sixty numbers], null, …]}
///
/// It is scored like a built-in method's: a frame without a pose shows the last one, and so counts in every joint
/// error; `frames_recovered` is the share of frames with a pose. Metrics of a built-in method's stages are missing.
using CaptureAnswer = std::vector<std::optional<BodyPose>>;
Result<CaptureAnswer> ReadCaptureAnswer(const Json& answer, std::size_t frames);

/// Records a built-in method's motion with its masks, as CaptureExtras. `name` is the name of its BVH clip. The frames
/// numbered `moments`, counted from 1, also keep their marks and the skeleton before inverse kinematics; numbers beyond
/// the take are ignored.
Recording MakeRecording(const CaptureWorld& world, const Take& take, const Observation& observation,
                        const CaptureBody& body, const std::vector<RecoveredFrame>& frames, const std::string& name,
                        std::span<const double> moments);

/// Records an outside method's answer: without masks, and with a BVH clip whose joints do not turn.
Recording MakeRecording(const CaptureWorld& world, const std::vector<BodyPose>& poses);

}  // namespace etude
