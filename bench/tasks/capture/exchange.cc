#include "bench/tasks/capture/exchange.h"

#include <nlohmann/json.hpp>

#include "bench/recordings/capture_extras.h"
#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/base/pose_json.h"
#include "bench/tasks/capture/coco.h"
#include "bench/tasks/capture/shooting.h"
#include "engine/base/base64.h"
#include "engine/cameras/opencv_file.h"
#include "engine/cameras/pose2sim_file.h"
#include "engine/formats/bvh.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/trc.h"
#include "engine/motion/clip.h"
#include "engine/vision/strokes.h"
#include "io/images/image_files.h"
#include "sim/camera/jpeg.h"
#include "sim/depth_camera/depth_camera.h"

namespace etude {
namespace {

Json ToJson(const glm::dvec2& v) { return {v.x, v.y}; }
Json ToJson(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Json ToJson(const LimbLengths& lengths) {
  Json json;
  for (const auto& [name, length] : kLimbLengths) json[name] = lengths.*length;
  return json;
}

/// Returns the calibration points as the text of a YAML file that `ReadPointPairs` reads.
std::string PairsFile(const CaptureWorld& world, const std::vector<std::vector<PointPair>>& pairs) {
  constexpr double kOurPixelCentre = 0.5;
  std::string text;
  for (std::size_t camera = 0; camera < pairs.size(); ++camera) {
    const Intrinsics& in = world.cameras[camera].intrinsics;
    text += fmt::format("camera-{}:\n  size: [{}, {}]\n  pairs:\n", camera + 1, in.width, in.height);
    for (const auto& [p_W, pixel] : pairs[camera]) {
      text += fmt::format("    - [{}, {}, {}, {}, {}]\n", p_W.x, p_W.y, p_W.z, pixel.x - kOurPixelCentre,
                          pixel.y - kOurPixelCentre);
    }
  }
  return text;
}

Json ToJson(const std::vector<PointPair>& pairs) {
  Json list = Json::array();
  for (const PointPair& pair : pairs) list.push_back({{"world_m", ToJson(pair.world)}, {"pixel", ToJson(pair.pixel)}});
  return list;
}

Json ToJson(const Marks& marks) {
  Json strokes = Json::array(), discs = Json::array();
  for (const auto& stroke : marks.strokes) {
    strokes.push_back(stroke ? Json{stroke->a.x, stroke->a.y, stroke->b.x, stroke->b.y} : Json(nullptr));
  }
  for (const auto& disc : marks.effectors) discs.push_back(disc ? ToJson(*disc) : Json(nullptr));
  return {{"strokes", std::move(strokes)}, {"discs", std::move(discs)}};
}

/// Encodes the marks as [camera][frame]. A frame that is not `marked` is null.
Json ToJson(const Observation& observation, const std::vector<bool>& marked) {
  Json cameras = Json::array();
  for (const std::vector<Marks>& frames : observation.marks) {
    Json& list = cameras.emplace_back(Json::array());
    for (std::size_t k = 0; k < frames.size(); ++k) list.push_back(marked[k] ? ToJson(frames[k]) : Json(nullptr));
  }
  return cameras;
}

/// Returns the name of a picture's file: "camera-1-0042.png", or "camera-1-background.png" without a frame. Cameras are
/// counted from one.
std::string PictureName(std::size_t camera, std::optional<std::size_t> frame, const char* extension) {
  if (!frame) return fmt::format("camera-{}-background.{}", camera + 1, extension);
  return fmt::format("camera-{}-{:04}.{}", camera + 1, *frame, extension);
}

/// Simulates the depth cameras of the first and the second Kinect at the place of one camera.
class DepthCameras {
 public:
  DepthCameras(const WorldKey& key, std::size_t camera)
      : v1_(key, fmt::format("capture/camera-{}/depth-v1", camera)),
        v2_(key, fmt::format("capture/camera-{}/depth-v2", camera)) {}

  std::array<DepthChannel, 2> Measure(const DepthImage& truth, const Camera& camera) {
    return {{{"Z_measured.v1", MeasureDepth(truth, camera, KinectV1Depth(), v1_)},
             {"Z_measured.v2", MeasureDepth(truth, camera, KinectV2Depth(), v2_)}}};
  }

 private:
  RandomStream v1_, v2_;
};

/// Fails if a take has too many pictures to be kept in memory.
Result<void> CheckSize(const CaptureWorld& world) {
  const std::size_t pictures = world.cameras.size() * world.truth.size();
  if (pictures <= kMaxPictures) return {};
  return Fail({},
              "a take of {} pictures is too long to be sent to other programs; allowed: at most {} pictures, a "
              "duration_s of at most {:g}",
              pictures, kMaxPictures, static_cast<double>(kMaxPictures / world.cameras.size()) / kJudgedRateHz);
}

Json PartNumbers() {
  constexpr std::array kPartNames = {"background",   "shadow",     "trunk",           "head",          "left_upper_arm",
                                     "left_forearm", "left_hand",  "right_upper_arm", "right_forearm", "right_hand",
                                     "left_thigh",   "left_shank", "left_foot",       "right_thigh",   "right_shank",
                                     "right_foot",   "furniture",  "clutter",         "bystander"};
  static_assert(kPartNames.size() == static_cast<std::size_t>(Part::kBystander) + 1);
  Json numbers = Json::object();
  for (std::size_t part = 0; part < kPartNames.size(); ++part) numbers[kPartNames[part]] = part;
  return numbers;
}

CaptureExtras DescribeStage(const CaptureWorld& world) {
  CaptureExtras extras;
  extras.texture_seed = world.room.texture_seed;
  extras.casts_shadows = world.room.casts_shadows;
  extras.stage_seed = world.stage_options.seed;
  extras.scene = world.stage_options.scene;
  extras.wears_everyday = world.stage_options.wardrobe == Wardrobe::kEveryday;
  extras.wears_coded = world.stage_options.wardrobe == Wardrobe::kCoded;
  extras.colours = world.colours;
  extras.brightness = world.brightness;
  return extras;
}

std::vector<CaptureExtras::Mark> StrokesOf(const Marks& marks) {
  std::vector<CaptureExtras::Mark> strokes;
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (const auto& stroke = marks.strokes[i]) strokes.push_back({stroke->a, stroke->b, StrokeMarks()[i].first_half});
  }
  return strokes;
}

}  // namespace

Payload DescribeStudio() {
  const Intrinsics camera;
  Json setting = {{"rate_hz", kJudgedRateHz}, {"image_width", camera.width}, {"image_height", camera.height}};
  setting.update(DescribeBody());
  for (const StrokeMark& mark : StrokeMarks()) {
    setting["strokes"].push_back({{"from", RoleName(mark.from)}, {"to", RoleName(mark.to)}});
  }
  for (const EffectorMark& mark : EffectorMarks()) setting["discs"].push_back(RoleName(mark.role));
  return PayloadOf(std::move(setting));
}

Result<Payload> MakeCaptureProblem(const StudioOptions& options, const WorldKey& key, CaptureStages& stages) {
  const CaptureWorld& world = stages.world();
  RETURN_IF_ERROR(CheckSize(world));
  ASSIGN_OR_RETURN(const auto renderer, stages.GetRenderer());

  // Make one source per segmenter, so that the marks of each segmenter are in the problem.
  std::vector<PersonSource> sources;
  for (const std::string& name : SegmenterNames()) sources.push_back({.segmenter = SegmenterNamed(name)});
  Payload problem = PayloadOf({});
  std::vector<std::vector<std::string>> pictures(world.cameras.size());
  Json cameras = Json::array();
  ASSIGN_OR_RETURN(const CalibrationPairs* calibration, stages.GetCalibrationPairs());
  for (const std::vector<PointPair>& pairs : *calibration) {
    cameras.push_back({{"calibration", ToJson(pairs)}, {"background", nullptr}, {"pictures", Json::array()}});
  }
  problem.files.push_back({"calibration-points.yaml", PairsFile(world, *calibration)});
  // Film the take once. Each picture becomes a file.
  const auto keep = [&](std::size_t camera, std::optional<std::size_t> frame, const ColourImage& picture) {
    problem.files.push_back({PictureName(camera, frame, "png"), EncodePng(picture)});
    const std::string& name = problem.files.back().name;
    if (frame) {
      cameras[camera]["pictures"].push_back(name);
      pictures[camera].push_back(name);
    } else {
      cameras[camera]["background"] = name;
    }
  };
  const Take take = Film(world, options, key, sources, /*wants_masks=*/false, *renderer, keep);
  Json marks = Json::object();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    marks[SegmenterNames()[i]] = ToJson(take.observations[i], stages.marked());
  }
  *problem.json = {{"frames", world.truth.size()},
                   {"limb_lengths_m", ToJson(world.measured.lengths)},
                   {"cameras", std::move(cameras)},
                   {"marks", std::move(marks)}};
  // Write the marks also as COCO keypoints.
  for (std::size_t i = 0; i < sources.size(); ++i) {
    for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
      ASSIGN_OR_RETURN(auto coco, WriteCocoKeypoints(world.cameras[camera].intrinsics, pictures[camera],
                                                     take.observations[i].marks[camera]));
      problem.files.push_back(
          {fmt::format("marks-{}-camera-{}.coco.json", SegmenterNames()[i], camera + 1), std::move(coco)});
    }
  }
  return problem;
}

Result<Payload> MakeCaptureTruth(CaptureStages& stages) {
  const CaptureWorld& world = stages.world();
  RETURN_IF_ERROR(CheckSize(world));
  Payload truth = PayloadOf({});
  *truth.json = {{"poses", EncodePoses(world.truth)}, {"labels", PartNumbers()}};
  const BodyMotion motion{kJudgedRateHz, world.truth};
  truth.files = {{"truth.bvh", WriteBvh(ToClip(motion, "truth"))},
                 {"truth.trc", WriteTrc(motion, "truth")},
                 {"truth.csv", WriteJointCsv(motion)}};
  std::vector<NamedCamera> rig;
  for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
    truth.files.push_back({fmt::format("camera-{}.yaml", camera + 1), WriteOpenCvCamera(world.cameras[camera])});
    rig.push_back({fmt::format("cam_{:02}", camera + 1), world.cameras[camera]});
  }
  truth.files.push_back({"calibration.toml", WritePose2SimCalibration(rig)});
  return truth;
}

Result<void> MakeCapturePictures(const StudioOptions& options, const WorldKey& key, CaptureStages& stages,
                                 const AttachmentSink& keep) {
  const CaptureWorld& world = stages.world();
  RETURN_IF_ERROR(CheckSize(world));
  ASSIGN_OR_RETURN(const auto renderer, stages.GetRenderer());
  // Shoot every frame with faultless cameras, and simulate the depth cameras.
  Shooting shooting(world, FaultlessPictures(options.camera), key, *renderer);
  for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
    DepthCameras depth_cameras(key, camera);
    for (std::size_t frame = 0; frame < world.truth.size(); ++frame) {
      const View view = shooting.Shoot(camera, frame, Targets::kAll);
      const auto measured = depth_cameras.Measure(view.depth, world.cameras[camera]);
      ASSIGN_OR_RETURN(auto bytes, EncodeExr(view, NormalsOf(view.depth, world.cameras[camera]), measured));
      RETURN_IF_ERROR(keep({PictureName(camera, frame, "exr"), std::move(bytes)}));
    }
  }
  return {};
}

Result<CaptureAnswer> ReadCaptureAnswer(const Json& json, std::size_t frames) {
  AnswerFields fields(json);
  const Json& poses = fields.List("poses", frames, frames);
  RETURN_IF_ERROR(fields.Finish());
  CaptureAnswer answer;
  for (const Json& entry : poses) {
    if (entry.is_null()) {
      answer.emplace_back();
      continue;
    }
    ASSIGN_OR_RETURN(const auto pose, ReadPose(entry, fields.PathOf("poses", answer.size())));
    answer.emplace_back(pose);
  }
  return answer;
}

Recording MakeRecording(const CaptureWorld& world, const Take& take, const Observation& observation,
                        const CaptureBody& body, const std::vector<RecoveredFrame>& frames, const std::string& name,
                        std::span<const double> moments) {
  Track truth{"truth", {kJudgedRateHz, world.truth}}, recovered{"recovered", {kJudgedRateHz, {}}};
  for (const RecoveredFrame& frame : frames) recovered.motion.poses.push_back(frame.pose);
  CaptureExtras extras = DescribeStage(world);
  for (std::size_t i = 0; i < world.cameras.size(); ++i) {
    constexpr int kStillQuality = 85;
    const std::string still = EncodeJpeg(take.stills[i], kStillQuality);
    extras.views.push_back({world.cameras[i], observation.masks[i], Base64(still)});
  }
  for (const double number : moments) {
    const auto frame = static_cast<std::size_t>(number) - 1;
    if (frame >= frames.size()) continue;
    CaptureExtras::Moment& moment = extras.moments.emplace_back();
    moment = {frame, frames[frame].fixed, {}};
    for (const std::vector<Marks>& marks : observation.marks) moment.marks.push_back(StrokesOf(marks[frame]));
  }
  extras.bvh = WriteBvh(ToClip(body, frames, kJudgedRateHz, name));
  return {{std::move(truth), std::move(recovered)}, WriteCaptureExtras(extras)};
}

Recording MakeRecording(const CaptureWorld& world, const std::vector<BodyPose>& poses) {
  const BodyMotion found{kJudgedRateHz, poses};
  CaptureExtras extras = DescribeStage(world);
  for (const Camera& camera : world.cameras) {
    const Mask nothing(camera.intrinsics.width / 2, camera.intrinsics.height / 2);
    extras.views.push_back({camera, std::vector<Mask>(poses.size(), nothing)});
  }
  extras.bvh = WriteBvh(ToClip(found, "recovered"));
  return {{{"truth", {kJudgedRateHz, world.truth}}, {"recovered", found}}, WriteCaptureExtras(extras)};
}

}  // namespace etude
