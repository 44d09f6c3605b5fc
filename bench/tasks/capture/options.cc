#include "bench/tasks/capture/options.h"

#include <algorithm>

#include "engine/cameras/rig_file.h"
#include "sim/render/scene.h"

namespace etude {
namespace {

Field<StudioOptions> Effect(const std::string& key, double CameraEffects::*effect, Range range, std::string meaning) {
  return Field<StudioOptions>::Number(key, Path(&StudioOptions::camera, effect), range, std::move(meaning));
}

/// Returns the keys of the cameras' optical and electronic effects, one for each member of CameraEffects, in the order
/// of the members.
std::vector<Field<StudioOptions>> CameraFields() {
  using E = CameraEffects;
  return {
      // Effects of the clock and the shutter.
      Effect("sync_offset_ms", &E::sync_offset_ms, {0, 500},
             "Offset of the clocks of all cameras but the first; its sign is random."),
      Effect("clock_drift_ppm", &E::clock_drift_ppm, {0, 50000},
             "Rate error of the clocks of all cameras but the first, in millionths; its sign is random."),
      Effect("rolling_shutter_ms", &E::rolling_shutter_ms, {0, 66},
             "Time between reading a picture's first row and its last."),
      Effect("motion_blur", &E::motion_blur, {0, 1}, "Exposure time as a share of the time between frames."),
      // Effects of the lens.
      Effect("radial_distortion", &E::radial_distortion, {-0.12, 0.25},
             "Shift of the picture's corner as a share of its distance from the centre; below 0 is barrel distortion."),
      Effect("tangential_distortion", &E::tangential_distortion, {0, 0.05},
             "Shift of the picture's corner by a lens that is not parallel to the sensor, as a share of its distance "
             "from the centre."),
      Effect("defocus_px", &E::defocus_px, {0, 10}, "Standard deviation of the Gaussian blur of a point."),
      Effect("vignette", &E::vignette, {0, 4},
             "Darkness of the corners; 1 is natural vignetting: cos⁴ of the angle from the optical axis."),
      Effect("dust", &E::dust, {0, 1}, "Share of the light that a speck of dust blocks at its centre."),
      // Effects of the sensor and of picture processing.
      Effect("exposure_ev", &E::exposure_ev, {-4, 4}, "Overexposure of the pictures, in stops."),
      Effect("exposure_drift_ev", &E::exposure_drift_ev, {0, 2}, "Largest drift of an automatic exposure, in stops."),
      Effect("gain_db", &E::gain_db, {0, 36},
             "Amplification: equally bright pictures from less light, with more noise."),
      Effect("white_balance_ev", &E::white_balance_ev, {-2, 2}, "Red relative to blue, in stops: above 0 is too warm."),
      Effect("white_balance_drift_ev", &E::white_balance_drift_ev, {0, 2},
             "Largest drift of an automatic white balance, in stops."),
      Effect("bayer", &E::bayer, {0, 1},
             "Effect of a Bayer sensor. 1: each pixel measures one colour, and the others are interpolated; 0: each "
             "pixel measures all colours; values between mix the two."),
      Effect("camera_noise", &E::noise, {0, 20}, "Multiplies the camera's usual noise."),
      Effect("jpeg_loss", &E::jpeg_loss, {0, 99}, "100 minus the quality of the JPEG file; 0: no JPEG.")};
}

void CheckStudio(Fields& fields, StudioOptions& options) {
  const RigOptions& rig = options.rig;
  if (rig.shape != RigShape::kAngles || rig.heights_m.size() == rig.angles_deg.size()) return;
  const Node* written = fields.Raw("camera_heights_m");
  fields.Complain((written != nullptr ? *written : fields.node()).place,
                  fmt::format("'camera_heights_m' has {} numbers; it needs one for each of the {} cameras",
                              rig.heights_m.size(), rig.angles_deg.size()));
}

FieldTable<StudioOptions> MakeConditionFields() {
  using Options = StudioOptions;
  using Key = Field<Options>;
  FieldTable<Options> made{
      {Key::Number("duration_s", &Options::duration_s, {0.1, 60}, "Length of the filmed window."),
       // Keys of the cameras' places.
       Key::Name("rig", Path(&Options::rig, &RigOptions::shape),
                 {{"angles", RigShape::kAngles},
                  {"stereo", RigShape::kStereo},
                  {"ring", RigShape::kRing},
                  {"corners", RigShape::kCorners},
                  {"file", RigShape::kFile}},
                 "How the cameras stand about the performer: at given angles, side by side in front, evenly around, in "
                 "four corners, or as in your calibration file."),
       Key{{kRigFileKey, FileKind("a calibration file"), "(none)",
            "Your own two to eight cameras, as `etude calibrate` writes them, or OpenCV's YAML, Pose2Sim's or "
            "Anipose's TOML, Qualisys' XML. The rig is moved as a whole to the performer."},
           [](Fields& condition, Options&) { condition.Raw(kRigFileKey); }}
           .With("rig", {"file"}),
       Key::Numbers("camera_angles_deg", Path(&Options::rig, &RigOptions::angles_deg), {2, kMaxCameras},
                    "two to eight of -180…180", {-180, 180},
                    "Directions of the cameras: 0 = in front, positive = to the performer's left.")
           .With("rig", {"angles"}),
       Key::Number("camera_baseline_m", Path(&Options::rig, &RigOptions::baseline_m), {0.05, 3},
                   "Distance between the two cameras.")
           .With("rig", {"stereo"}),
       Key::Number("cameras", Path(&Options::rig, &RigOptions::cameras), {2, kMaxCameras},
                   "Number of cameras in the ring.")
           .With("rig", {"ring"}),
       Key::Numbers("camera_heights_m", Path(&Options::rig, &RigOptions::heights_m), {1, kMaxCameras},
                    "one to eight of 0.2…5", {0.2, 5},
                    "Heights of the cameras. At given angles: one height per angle; in a ring or in corners: the list "
                    "is repeated until every camera has a height; side by side: both cameras have the first height."),
       Key::Number(
           "camera_distance_m", Path(&Options::rig, &RigOptions::distance_m), {2, 10},
           "Distance of the cameras from the middle of the performer's path; less where the room is too small."),
       // Keys of the performer, the room and the light.
       Key::Name("figure", &Options::figure, {{"staged", PerformerFigure::kStaged}, {"own", PerformerFigure::kOwn}},
                 "The figure: the stage's own people, or the meshes and textures in the clips' files (glTF)."),
       Key::Name("clothes", &Options::clothes,
                 {{"studio", Clothes::kStudio}, {"everyday", Clothes::kEveryday}, {"coded", Clothes::kCoded}},
                 "Clothes of the stage's people: colours unlike the room's; a grey shirt and trousers of the floor's "
                 "hue; or a suit with a different colour for every limb."),
       Key::Number("scene", &Options::scene, {0, 1},
                   "How much the set resembles a lived-in room: 0 = the studio, 1 = furniture, clutter, a second "
                   "person, similar hues."),
       Key::Number("light_drift", &Options::light_drift, {0, 0.5}, "Largest relative change of the lamp's brightness."),
       // Keys of calibration, measurements and annotation.
       Key::Name("calibration_target", &Options::calibration_target,
                 {{"points", CalibrationTargetKind::kPoints}, {"boards", CalibrationTargetKind::kBoards}},
                 "What the cameras are calibrated with: points on planes, clicked by the annotator; or a cube of coded "
                 "boards, found in the picture."),
       Key::Number("calibration_pairs", &Options::calibration_pairs, {6, 1000}, "Number of clicked points per camera.")
           .With("calibration_target", {"points"}),
       Key::Number("calibration_measure_mm", &Options::calibration_measure_mm, {0, 100},
                   "Standard deviation of the measured position of each point or board, along each axis."),
       Key::Number("calibration_noise_px", &Options::calibration_noise_px, {0, 20},
                   "Standard deviation of a click on a calibration point, in u and in v.")
           .With("calibration_target", {"points"}),
       Key::Number(
           "annotation_error_px", &Options::annotation_error_px, {0, 50},
           "Standard deviation of an annotator's marks, in u and in v; an annotator's other errors grow with it."),
       Key::Number("limb_measure_mm", &Options::limb_measure_mm, {0, 100},
                   "Standard deviation of each of the performer's measured limb lengths."),
       Key::Number("annotators", &Options::annotators, {1, 2},
                   "Number of annotators who mark the same pictures independently; methods get the mean of both."),
       Key::Number("mark_every", &Options::mark_every, {1, 300},
                   "The annotator marks every n-th frame; what lies between is interpolated."),
       Key::Numbers(
           "moments", &Options::moments, {0, 12}, "up to twelve of 1…1800", {1, 1800},
           "Frames, counted from 1, for which the report shows every stage, as in figures 5.3 to 5.14 of paper B.")},
      CheckStudio};
  Append(CameraFields(), made.fields);
  return made;
}

void CheckMethod(Fields& fields, CaptureMethod& method) {
  const Oracle& oracle = method.oracle;
  if (method.recovery == Recovery::kKeypoints) {
    method.lengths = LengthSource::kMeasured;  // this kind of recovery always measures the limb lengths
    if (oracle.lengths)
      fields.Complain(
          fields.Raw("oracle")->place,
          "'oracle: [lengths]' cannot be used with 'recovery: keypoints', which measures the limb lengths itself");
  }
  if (method.marks == MarkSource::kColours && oracle.marks) {
    fields.Complain(fields.Raw("oracle")->place,
                    "'oracle: [marks]' and 'marks: colours' exclude each other: both say who marks the pictures");
  }
  // Silhouettes use marks only if `start` is `keypoints`.
  if (method.recovery == Recovery::kSilhouettes) {
    const bool has_marks = method.start == SilhouetteStart::kKeypoints;
    if (!has_marks && (oracle.marks || method.lengths == LengthSource::kMeasured)) {
      fields.Complain(fields.node().place,
                      "'recovery: silhouettes' without 'start: keypoints' has no marks: 'oracle: [marks]' and "
                      "'lengths: measured' need them");
    }
    if (has_marks && method.causal) {
      fields.Complain(fields.Raw("causal")->place, "'start: keypoints' needs the whole take; it cannot be causal");
    }
  }
  // A causal method must not use data that depend on the whole take.
  const bool knows_all =
      method.smoothing != Smoothing::kNone || method.sync != Sync::kAssumed || method.lengths != LengthSource::kKnown;
  if (method.causal && knows_all) {
    fields.Complain(
        fields.Raw("causal")->place,
        "'causal: true' excludes smoothing, measured lengths and estimated clocks: these need the whole take");
  }
  if (method.recovery == Recovery::kIk || !(oracle.directions || oracle.points || oracle.start || oracle.ik)) return;
  fields.Complain(fields.Raw("oracle")->place, "only 'recovery: ik' has the stages directions, points, start and ik");
}

void CheckSeatedMethod(Fields& fields, CaptureMethod& method) {
  CheckMethod(fields, method);
  if (method.seat != CaptureSeat::kSegmenter) return;
  if (const Node* segmenter = fields.node().Find("segmenter")) {
    fields.Complain(segmenter->place, "'segmenter' has no effect here: the program in 'seat: segmenter' replaces it");
  }
  if (method.oracle.segmentation) {
    fields.Complain(
        fields.Raw("oracle")->place,
        "'oracle: [segmentation]' has no effect here: the program in 'seat: segmenter' replaces segmentation");
  }
}

}  // namespace

const FieldTable<StudioOptions>& CaptureConditionFields() {
  static const FieldTable<StudioOptions> table = MakeConditionFields();
  return table;
}

const FieldTable<CaptureMethod>& CaptureMethodFields() {
  using Method = CaptureMethod;
  using Key = Field<Method>;
  static const FieldTable<Method> table = [] {
    FieldTable<Method> made{
        // Keys of the stages from pictures to marks and cameras.
        {Key::Name("segmenter", &Method::segmenter, SegmenterNames(), SegmenterNamed,
                   "How the person is cut out of the pictures."),
         Key::Name("pieces", &Method::pieces, {{"largest", PersonPieces::kLargest}, {"large", PersonPieces::kLarge}},
                   "Which changed regions are the person: the largest alone (paper B), or also every other large one.")
             .With("recovery", {"ik", "ends", "bundle", "keypoints"}),
         Key::Name("marks", &Method::marks, {{"annotator", MarkSource::kAnnotator}, {"colours", MarkSource::kColours}},
                   "Where limb marks come from: the annotator, or the colours of a suit (needs `clothes: coded`).")
             .With("recovery", {"ik", "ends", "bundle", "keypoints"}),
         Key::Name("calibration", &Method::calibration, CalibrationNames(), CalibrationNamed,
                   "How a camera is computed from its calibration points."),
         Key::Name("sync", &Method::sync, {{"assumed", Sync::kAssumed}, {"estimated", Sync::kEstimated}},
                   "Whether the cameras' clocks are assumed to agree, or estimated from the motion of marks."),
         Key::Name("outliers", &Method::outliers, {{"keep", OutlierRule::kKeep}, {"reject", OutlierRule::kReject}},
                   "Whether a camera that disagrees with two or more others about a mark is left out."),
         Key::Name("body", &Method::body, {{"fitted", BodyKind::kFitted}, {"paper", BodyKind::kPaper}},
                   "The performer's own joints, or paper B's 29 degrees of freedom.")
             .With("recovery", {"ik"}),
         // Keys of the stages from marks or silhouettes to poses.
         Key::Name(
             "recovery", &Method::recovery,
             {{"ik", Recovery::kIk},
              {"ends", Recovery::kEnds},
              {"bundle", Recovery::kBundle},
              {"keypoints", Recovery::kKeypoints},
              {"silhouettes", Recovery::kSilhouettes}},
             "How pictures become poses: paper B's inverse kinematics; triangulation of every joint from the strokes "
             "that end there; bundle adjustment of paper B's body over the whole take; `etude capture`'s fit of a "
             "body, with its own limb lengths, to all marks; or a body fitted to the silhouettes, without marks."),
         Key::Name("start", &Method::start,
                   {{"cold", SilhouetteStart::kCold},
                    {"near", SilhouetteStart::kNear},
                    {"keypoints", SilhouetteStart::kKeypoints}},
                   "What is known besides the silhouettes: nothing; every angle of the first pose to within 10°; or "
                   "the marked joints of every picture, which stand for an estimator's keypoints.")
             .With("recovery", {"silhouettes"}),
         Key::Name("smoothing", &Method::smoothing, {{"none", Smoothing::kNone}, {"rts", Smoothing::kRts}},
                   "How the joints of the whole take are smoothed afterwards: not at all, or by a Rauch-Tung-Striebel "
                   "smoother.")
             .With("recovery", {"ik", "ends", "bundle"}),
         Key::Name("lengths", &Method::lengths,
                   {{"known", LengthSource::kKnown}, {"measured", LengthSource::kMeasured}},
                   "Whether limb lengths are known beforehand, or measured from the marks of a few frames.")
             .With("recovery", {"ik", "ends", "bundle", "silhouettes"}),
         Key::Flag("causal", &Method::causal,
                   "Whether each frame's skeleton depends only on the pictures up to it, as in a live system.")
             .With("recovery", {"ik", "silhouettes"}),
         ToleranceField(&Method::ik, "Largest deviation of an angle from the one seen in the pictures.")
             .With("recovery", {"ik"}),
         SweepsField(&Method::ik, "Maximum number of solver steps per frame.").With("recovery", {"ik"}),
         Key::Flags("oracle",
                    {{"calibration", Path(&Method::oracle, &Oracle::calibration)},
                     {"segmentation", Path(&Method::oracle, &Oracle::segmentation)},
                     {"marks", Path(&Method::oracle, &Oracle::marks)},
                     {"directions", Path(&Method::oracle, &Oracle::directions)},
                     {"points", Path(&Method::oracle, &Oracle::points)},
                     {"lengths", Path(&Method::oracle, &Oracle::lengths)},
                     {"start", Path(&Method::oracle, &Oracle::start)},
                     {"ik", Path(&Method::oracle, &Oracle::ik)}},
                    "Stages replaced by the truth.")},
        CheckMethod};
    // The keys of the solver, which only recovery by inverse kinematics has.
    std::vector<Key> solver = IkSolverFields(&Method::solver, &Method::ik);
    solver.front() = solver.front().With("recovery", {"ik"});
    Append(std::move(solver), made.fields);
    return made;
  }();
  return table;
}

const std::vector<std::string>& CaptureSeatNames() {
  static const std::vector<std::string> names = {"segmenter"};
  return names;
}

const FieldTable<CaptureMethod>& SeatedCaptureMethodFields() {
  static const FieldTable<CaptureMethod> table = [] {
    FieldTable<CaptureMethod> made = CaptureMethodFields();
    made.fields.push_back(
        Field<CaptureMethod>::Name("seat", &CaptureMethod::seat, {{CaptureSeatNames()[0], CaptureSeat::kSegmenter}},
                                   "The stage that the program of `exec` replaces: it cuts out the person.")
            .WhenAbsent("(with `exec`: the whole capture)")
            .And("with `exec`"));
    made.check = CheckSeatedMethod;
    return made;
  }();
  return table;
}

Result<void> CheckMarks(const StudioOptions& options, const CaptureMethod& method, const Place& place) {
  if (method.marks != MarkSource::kColours) return {};
  if (options.figure == PerformerFigure::kOwn) {
    return Fail(place, "'marks: colours' cannot be used with 'figure: own', whose clothes come from the file");
  }
  if (options.clothes == Clothes::kCoded) return {};
  return Fail(place, "'marks: colours' reads the colours of a suit; allowed with clothes: coded");
}

PersonSource PersonSourceOf(const CaptureMethod& method) {
  const bool for_silhouettes = method.recovery == Recovery::kSilhouettes;
  PersonSource source{.segmenter = method.segmenter,
                      .pieces = for_silhouettes ? PersonPieces::kLarge : method.pieces,
                      .is_truth = false,
                      .for_silhouettes = for_silhouettes,
                      .has_keypoints = for_silhouettes && method.start == SilhouetteStart::kKeypoints,
                      .program = method.program,
                      .has_true_marks = method.oracle.marks,
                      .has_coloured_marks = method.marks == MarkSource::kColours};
  if (method.oracle.segmentation) {
    source.segmenter = Segmenter::kHue;
    source.pieces = PersonPieces::kLargest;
    source.is_truth = true;
  }
  return source;
}

void AddSource(const PersonSource& source, std::vector<PersonSource>& sources) {
  if (std::ranges::find(sources, source) == sources.end()) sources.push_back(source);
}

Result<void> OpenOwnCameras(const TaskInput& input, StudioOptions& options) {
  if (options.rig.shape != RigShape::kFile) return {};
  const Node& condition = input.condition.node();
  // Fail unless the condition has the key `rig_file` and the text of that file.
  const Node* named = condition.Find(kRigFileKey);
  const auto text = input.texts.find(kRigFileKey);
  if (named == nullptr || text == input.texts.end()) {
    return Fail((named != nullptr ? *named : condition).place, "'rig: file' needs '{}', a calibration file",
                kRigFileKey);
  }
  ASSIGN_OR_RETURN(const auto cameras, ReadRig(text->second, named->scalar));
  if (cameras.size() < 2 || cameras.size() > kMaxCameras) {
    return Fail(named->place, "'{}' has {} cameras; allowed: 2 to {}", named->scalar, cameras.size(), kMaxCameras);
  }
  std::vector<Camera>& own = options.rig.own;
  // Every camera must have a possible size, lens and position.
  for (const NamedCamera& camera : cameras) {
    const Intrinsics& in = camera.camera.intrinsics;
    if (in.width < 1 || in.height < 1 || in.width > kMaxPictureSide || in.height > kMaxPictureSide) {
      return Fail(named->place, "camera '{}' of '{}' takes pictures of {} × {} pixels; allowed: 1 to {} a side",
                  camera.name, named->scalar, in.width, in.height, kMaxPictureSide);
    }
    const Distortion& lens = camera.camera.distortion;
    if (lens != Distortion{lens.k1, lens.k2, lens.p1, lens.p2, lens.k3}) {
      return Fail(named->place,
                  "camera '{}' of '{}' has a lens model that scenarios cannot use; allowed: Brown and Conrady's (k1, "
                  "k2, p1, p2, k3)",
                  camera.name, named->scalar);
    }
    constexpr double kMaxDistance = 100;
    if (const double far = glm::length(camera.camera.p_WC); far > kMaxDistance) {
      return Fail(named->place,
                  "camera '{}' of '{}' is {:.0f} m from the origin; allowed: at most {:g} m. Is the file in metres?",
                  camera.name, named->scalar, far, kMaxDistance);
    }
    own.push_back(camera.camera);
  }
  return {};
}

}  // namespace etude
