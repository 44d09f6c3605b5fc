#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/capture/stages.h"
#include "engine/capture/recover_frames.h"

namespace etude {

/// Describes the studio to outside methods, which receive takes of two or more cameras. Units are metres; Y is up;
/// the frame is right-handed. A pose is sixty numbers (EncodePose). Pixel coordinates are u to the right and v down;
/// (0, 0) is the top left corner of the picture, and (0.5, 0.5) the centre of the first pixel.
///
/// Setting:
///
///     {"rate_hz": 30, "joints": ["hip_centre", …], "parents": [null, "hip_centre", …],
///      "strokes": [{"from": "left_hip", "to": "left_knee"}, …], "discs": ["left_foot", …]}
///
/// `strokes` are the thirteen limbs that the annotator marks with a line; `discs` are the five ends that the annotator
/// marks with a point.
Payload DescribeStudio();

/// Makes the problem of a take: the limb lengths of the performer and, for each camera, its calibration points (a
/// position in the world and the pixel clicked for it), a picture of the empty stage, and a picture per frame. Pictures
/// are separate files.
///
///     {"frames": 150, "limb_lengths_m": {"foot": 0.18, "shank": 0.42, …},
///      "cameras": [{"image_width": 640, "image_height": 480,
///                   "calibration": [{"world_m": [x, y, z], "pixel": [u, v]}, …],
///                   "background": "camera-1-background.png",
///                   "pictures": ["camera-1-0000.png", …]}, …],
///      "marks": {"hue": [[{"strokes": [[u, v, u, v], null, …], "discs": [[u, v], null, …]}, …], […]], "hue-gated": …}}
///
/// `marks` are the annotator's marks on each camera's frames, as built-in methods receive them. They are for methods
/// without vision of their own. The annotator draws on the person that a segmenter has cut out, so parts that the
/// segmenter lost are not marked. Marks are listed by segmenter, then [camera][frame]. A frame is null if the annotator
/// did not have to mark it; a mark is null if it is missing or unreadable. A stroke goes from its limb's `from` to its
/// `to`.
///
/// The marks are also given as COCO keypoints, in the files `marks-hue-camera-1.coco.json` and so on (coco.h). The
/// calibration points are also given in the format of `etude calibrate`, in the file `calibration-points.yaml`.
///
/// Fails without a renderer, and if a take has more than kMaxPictures pictures.
Result<Payload> MakeCaptureProblem(const StudioOptions& options, const WorldKey& key, CaptureStages& stages);
constexpr std::size_t kMaxPictures = 1200;

/// Makes the truth of a take: the true poses, in the format of an answer. The files `truth.bvh`, `truth.trc` and
/// `truth.csv` hold the same poses for other programs. The files `camera-1.yaml`… are OpenCV calibration files;
/// `calibration.toml` holds all cameras in Pose2Sim's format.
///
///     {"poses": [[sixty numbers], …], "labels": {"background": 0, "shadow": 1, "trunk": 2, …}}
Result<Payload> MakeCaptureTruth(CaptureStages& stages);

/// Makes the pictures of the truth and passes them to `keep`. The file `camera-1-0000.exr` of a frame holds `label`,
/// `Z` (depth along the viewing axis, metres), `N.X`, `N.Y`, `N.Z` (normals in the world), and `R`, `G`, `B` (the
/// linear light of a camera with this lens and clock but no other faults). `Z_measured.v1` and `Z_measured.v2` are the
/// depths that the depth cameras of the first and second Kinect would measure from the same place (sim/depth_camera);
/// they are infinite where nothing is measured. Fails without a renderer.
Result<void> MakeCapturePictures(const StudioOptions& options, const WorldKey& key, CaptureStages& stages,
                                 const AttachmentSink& keep);

/// The answer of an outside method. It has one entry per frame: a pose, or null.
///
///     {"poses": [[sixty numbers], null, …]}
///
/// It is scored like the result of a built-in method. A frame without a pose counts in every joint error: it gets the
/// last pose before it, or the answer's first pose if there is none. `frames_recovered` is the share of frames with a
/// pose. The metrics of a built-in method's stages are missing.
using CaptureAnswer = std::vector<std::optional<BodyPose>>;
Result<CaptureAnswer> ReadCaptureAnswer(const Json& answer, std::size_t frames);

/// Records a built-in method's motion with its masks (CaptureExtras). `name` is the name of the recording's BVH clip.
/// The frames numbered `moments`, counted from 1, also keep their marks and the skeleton before inverse kinematics.
/// Numbers beyond the end of the take are ignored.
Recording MakeRecording(const CaptureWorld& world, const Take& take, const Observation& observation,
                        const CaptureBody& body, const std::vector<RecoveredFrame>& frames, const std::string& name,
                        std::span<const double> moments);

/// Records an outside method's answer. The recording has no masks, and the joints of its BVH clip do not turn.
Recording MakeRecording(const CaptureWorld& world, const std::vector<BodyPose>& poses);

}  // namespace etude
