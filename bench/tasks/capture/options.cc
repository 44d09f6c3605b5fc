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
             "Time offset between the first camera's clock and the clock of every other camera. The sign of each "
             "offset is random."),
      Effect("clock_drift_ppm", &E::clock_drift_ppm, {0, 50000},
             "Rate error of the clock of every camera except the first, in parts per million. The sign of each error "
             "is random."),
      Effect("rolling_shutter_ms", &E::rolling_shutter_ms, {0, 66},
             "Time between the readout of a picture's first row and the readout of its last row."),
      Effect("motion_blur", &E::motion_blur, {0, 1}, "Exposure time as a share of the time between frames."),
      // Effects of the lens.
      Effect("radial_distortion", &E::radial_distortion, {-0.12, 0.25},
             "Radial shift of a picture's corner, as a share of the corner's distance from the centre. Values below 0 "
             "are barrel distortion."),
      Effect("tangential_distortion", &E::tangential_distortion, {0, 0.05},
             "Shift of a picture's corner if the lens is not parallel to the sensor, as a share of the corner's "
             "distance from the centre."),
      Effect("defocus_px", &E::defocus_px, {0, 10},
             "Standard deviation of the Gaussian blur of a point in the picture."),
      Effect("vignette", &E::vignette, {0, 4},
             "Strength of the darkening of a picture's corners. 1 is natural vignetting, which is cos⁴ of the angle "
             "from the optical axis."),
      Effect("dust", &E::dust, {0, 1}, "Share of the light that the centre of a speck of dust blocks."),
      // Effects of the sensor and of picture processing.
      Effect("exposure_ev", &E::exposure_ev, {-4, 4},
             "Exposure error of the pictures, in stops. Values above 0 make the pictures too bright."),
      Effect("exposure_drift_ev", &E::exposure_drift_ev, {0, 2}, "Largest drift of the automatic exposure, in stops."),
      Effect("gain_db", &E::gain_db, {0, 36},
             "Amplification of the sensor's signal. With amplification, pictures from less light are equally bright, "
             "but have more noise."),
      Effect("white_balance_ev", &E::white_balance_ev, {-2, 2},
             "Error of the white balance: red relative to blue, in stops. Values above 0 make the colours too warm."),
      Effect("white_balance_drift_ev", &E::white_balance_drift_ev, {0, 2},
             "Largest drift of the automatic white balance, in stops."),
      Effect("bayer", &E::bayer, {0, 1},
             "Effect of a Bayer sensor. With 1, each pixel measures one colour, and the other colours are "
             "interpolated. With 0, each pixel measures all colours. Values between 0 and 1 mix the two pictures."),
      Effect("camera_noise", &E::noise, {0, 20}, "Factor that multiplies the camera's usual noise."),
      Effect("jpeg_loss", &E::jpeg_loss, {0, 99},
             "100 minus the quality of the JPEG compression. 0 turns JPEG compression off.")};
}

void CheckStudio(Fields& fields, StudioOptions& options) {
  const RigOptions& rig = options.rig;
  if (rig.shape != RigShape::kAngles || rig.heights_m.size() == rig.angles_deg.size()) return;
  const Node* written = fields.Raw("camera_heights_m");
  fields.Complain((written != nullptr ? *written : fields.node()).place,
                  fmt::format("'camera_heights_m' has {} numbers; needed: one number for each of the {} cameras",
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
                 "The arrangement of the cameras. angles: at given angles around the performer; stereo: side by side "
                 "in front of the performer; ring: at equal angles around the performer; corners: in four corners; "
                 "file: as in your calibration file."),
       Key{{kRigFileKey, FileKind("a calibration file"), "(none)",
            "A file with your own two to eight cameras: a file that `etude calibrate` wrote, YAML of OpenCV, TOML of "
            "Pose2Sim or Anipose, or XML of Qualisys. Etude moves the rig as a whole to the performer."},
           [](Fields& condition, Options&) { condition.Raw(kRigFileKey); }}
           .With("rig", {"file"}),
       Key::Numbers("camera_angles_deg", Path(&Options::rig, &RigOptions::angles_deg), {2, kMaxCameras},
                    "two to eight numbers from -180 to 180", {-180, 180},
                    "Directions of the cameras, seen from the performer. 0 is in front, and positive angles are to the "
                    "performer's left.")
           .With("rig", {"angles"}),
       Key::Number("camera_baseline_m", Path(&Options::rig, &RigOptions::baseline_m), {0.05, 3},
                   "Distance between the two cameras.")
           .With("rig", {"stereo"}),
       Key::Number("cameras", Path(&Options::rig, &RigOptions::cameras), {2, kMaxCameras},
                   "Number of cameras in the ring.")
           .With("rig", {"ring"}),
       Key::Numbers("camera_heights_m", Path(&Options::rig, &RigOptions::heights_m), {1, kMaxCameras},
                    "one to eight numbers from 0.2 to 5", {0.2, 5},
                    "Heights of the cameras above the floor. With `rig: angles`, the list has one height for each "
                    "camera. With `ring` or `corners`, the list is repeated until every camera has a height. With "
                    "`stereo`, both cameras have the first height."),
       Key::Number("camera_distance_m", Path(&Options::rig, &RigOptions::distance_m), {2, 10},
                   "Distance of the cameras from the middle of the performer's path. Where the room is too small, the "
                   "distance is shorter."),
       // Keys of the performer, the room and the light.
       Key::Name("figure", &Options::figure, {{"staged", PerformerFigure::kStaged}, {"own", PerformerFigure::kOwn}},
                 "The figure in the pictures. staged: a person of the simulated stage; own: the mesh and textures in "
                 "the clip's file (glTF)."),
       Key::Name(
           "clothes", &Options::clothes,
           {{"studio", Clothes::kStudio}, {"everyday", Clothes::kEveryday}, {"coded", Clothes::kCoded}},
           "Clothes of the stage's people. studio: colours that differ from the room's colours; everyday: a grey "
           "shirt, and trousers with the hue of the floor; coded: a suit with a different colour for every limb."),
       Key::Number(
           "scene", &Options::scene, {0, 1},
           "How difficult the room is. 0: an empty studio; 1: furniture, clutter, a second person and similar hues."),
       Key::Number("light_drift", &Options::light_drift, {0, 0.5}, "Largest relative change of the lamp's brightness."),
       // Keys of calibration, measurements and annotation.
       Key::Name("calibration_target", &Options::calibration_target,
                 {{"points", CalibrationTargetKind::kPoints}, {"boards", CalibrationTargetKind::kBoards}},
                 "The calibration target. points: points on planes, which the annotator clicks; boards: a cube of "
                 "coded boards, which are found in the picture."),
       Key::Number("calibration_pairs", &Options::calibration_pairs, {6, 1000}, "Number of clicked points per camera.")
           .With("calibration_target", {"points"}),
       Key::Number("calibration_measure_mm", &Options::calibration_measure_mm, {0, 100},
                   "Standard deviation of the error in the measured position of each point or board, along each axis."),
       Key::Number("calibration_noise_px", &Options::calibration_noise_px, {0, 20},
                   "Standard deviation of the error of a click on a calibration point, in u and in v.")
           .With("calibration_target", {"points"}),
       Key::Number("annotation_error_px", &Options::annotation_error_px, {0, 50},
                   "Standard deviation of the error of an annotator's marks, in u and in v. The annotator's other "
                   "errors grow with this value."),
       Key::Number("limb_measure_mm", &Options::limb_measure_mm, {0, 100},
                   "Standard deviation of the error in each measured limb length of the performer."),
       Key::Number("annotators", &Options::annotators, {1, 2},
                   "Number of annotators who mark the same pictures independently. With two annotators, methods get "
                   "the mean of their marks."),
       Key::Number("mark_every", &Options::mark_every, {1, 300},
                   "The annotator marks every n-th frame. Marks in the frames between are interpolated."),
       Key::Numbers("moments", &Options::moments, {0, 12}, "up to twelve numbers from 1 to 1800", {1, 1800},
                    "Frames for which the report shows every stage, as figures 5.3 to 5.14 of paper B do. Frames are "
                    "counted from 1.")},
      CheckStudio};
  Append(CameraFields(), made.fields);
  return made;
}

void CheckMethod(Fields& fields, CaptureMethod& method) {
  const Oracle& oracle = method.oracle;
  if (method.recovery == Recovery::kKeypoints) {
    method.lengths = LengthSource::kMeasured;  // this kind of recovery always measures the limb lengths
    if (oracle.lengths)
      fields.Complain(fields.Raw("oracle")->place,
                      "'oracle: [lengths]' is not allowed with 'recovery: keypoints', because this recovery measures "
                      "the limb lengths");
  }
  if (method.marks == MarkSource::kColours && oracle.marks) {
    fields.Complain(fields.Raw("oracle")->place,
                    "'oracle: [marks]' and 'marks: colours' are not allowed together, because both define where the "
                    "marks come from");
  }
  // Silhouettes use marks only if `start` is `keypoints`.
  if (method.recovery == Recovery::kSilhouettes) {
    const bool has_marks = method.start == SilhouetteStart::kKeypoints;
    if (!has_marks && (oracle.marks || method.lengths == LengthSource::kMeasured)) {
      fields.Complain(fields.node().place,
                      "'oracle: [marks]' and 'lengths: measured' need marks; with 'recovery: silhouettes', only "
                      "'start: keypoints' makes marks");
    }
    if (has_marks && method.causal) {
      fields.Complain(fields.Raw("causal")->place,
                      "'causal: true' is not allowed with 'start: keypoints', which needs the whole take");
    }
  }
  // A causal method must not use data that depend on the whole take.
  const bool knows_all =
      method.smoothing != Smoothing::kNone || method.sync != Sync::kAssumed || method.lengths != LengthSource::kKnown;
  if (method.causal && knows_all) {
    fields.Complain(fields.Raw("causal")->place,
                    "'causal: true' is not allowed with smoothing, measured lengths or estimated clocks, because they "
                    "need the whole take");
  }
  if (method.recovery == Recovery::kIk || !(oracle.directions || oracle.points || oracle.start || oracle.ik)) return;
  fields.Complain(fields.Raw("oracle")->place,
                  "the stages directions, points, start and ik in 'oracle' are allowed only with 'recovery: ik'");
}

void CheckSeatedMethod(Fields& fields, CaptureMethod& method) {
  CheckMethod(fields, method);
  if (method.seat != CaptureSeat::kSegmenter) return;
  if (const Node* segmenter = fields.node().Find("segmenter")) {
    fields.Complain(segmenter->place,
                    "'segmenter' has no effect, because the program in 'seat: segmenter' replaces the segmenter");
  }
  if (method.oracle.segmentation) {
    fields.Complain(
        fields.Raw("oracle")->place,
        "'oracle: [segmentation]' has no effect, because the program in 'seat: segmenter' replaces segmentation");
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
                   "The method that separates the person from the background of the pictures."),
         Key::Name("pieces", &Method::pieces, {{"largest", PersonPieces::kLargest}, {"large", PersonPieces::kLarge}},
                   "The changed regions that count as the person. largest: only the largest region (paper B); large: "
                   "every large region.")
             .With("recovery", {"ik", "ends", "bundle", "keypoints"}),
         Key::Name("marks", &Method::marks, {{"annotator", MarkSource::kAnnotator}, {"colours", MarkSource::kColours}},
                   "The source of limb marks. annotator: the annotator's drawings; colours: the colours of a suit, "
                   "which needs `clothes: coded`.")
             .With("recovery", {"ik", "ends", "bundle", "keypoints"}),
         Key::Name("calibration", &Method::calibration, CalibrationNames(), CalibrationNamed,
                   "The method that computes a camera from the camera's calibration points."),
         Key::Name("sync", &Method::sync, {{"assumed", Sync::kAssumed}, {"estimated", Sync::kEstimated}},
                   "assumed: the cameras' clocks are assumed to agree; estimated: the time offsets are estimated from "
                   "the motion of marks."),
         Key::Name("outliers", &Method::outliers, {{"keep", OutlierRule::kKeep}, {"reject", OutlierRule::kReject}},
                   "reject: if a camera disagrees with two or more other cameras about a mark, this camera's mark is "
                   "left out; keep: every mark is used."),
         Key::Name("body", &Method::body, {{"fitted", BodyKind::kFitted}, {"paper", BodyKind::kPaper}},
                   "The body model. fitted: a body with the performer's joints; paper: paper B's body with 29 degrees "
                   "of freedom.")
             .With("recovery", {"ik"}),
         // Keys of the stages from marks or silhouettes to poses.
         Key::Name("recovery", &Method::recovery,
                   {{"ik", Recovery::kIk},
                    {"ends", Recovery::kEnds},
                    {"bundle", Recovery::kBundle},
                    {"keypoints", Recovery::kKeypoints},
                    {"silhouettes", Recovery::kSilhouettes}},
                   "The method that computes poses from pictures. ik: paper B's inverse kinematics; ends: "
                   "triangulation of every joint from the strokes that end there; bundle: bundle adjustment of paper "
                   "B's body over the whole take; keypoints: the method of `etude capture`, which fits a body and its "
                   "limb lengths to all marks; silhouettes: a body fitted to the silhouettes, without marks."),
         Key::Name("start", &Method::start,
                   {{"cold", SilhouetteStart::kCold},
                    {"near", SilhouetteStart::kNear},
                    {"keypoints", SilhouetteStart::kKeypoints}},
                   "What the method knows in addition to the silhouettes. cold: nothing; near: every angle of the "
                   "first pose to within 10°; keypoints: the marked joints of every picture, as a substitute for the "
                   "keypoints of an estimator.")
             .With("recovery", {"silhouettes"}),
         Key::Name(
             "smoothing", &Method::smoothing, {{"none", Smoothing::kNone}, {"rts", Smoothing::kRts}},
             "Smoothing of the joints over the whole take. none: no smoothing; rts: a Rauch-Tung-Striebel smoother.")
             .With("recovery", {"ik", "ends", "bundle"}),
         Key::Name("lengths", &Method::lengths,
                   {{"known", LengthSource::kKnown}, {"measured", LengthSource::kMeasured}},
                   "known: the limb lengths are given; measured: the limb lengths are measured from the marks of a few "
                   "frames.")
             .With("recovery", {"ik", "ends", "bundle", "silhouettes"}),
         Key::Flag("causal", &Method::causal,
                   "true: as in a live system, the skeleton of a frame depends only on pictures up to this frame.")
             .With("recovery", {"ik", "silhouettes"}),
         ToleranceField(&Method::ik,
                        "Largest allowed deviation of a solved angle from the angle that is seen in the pictures.")
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
                    "Stages whose output is replaced by the truth.")},
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
    made.fields.push_back(Field<CaptureMethod>::Name("seat", &CaptureMethod::seat,
                                                     {{CaptureSeatNames()[0], CaptureSeat::kSegmenter}},
                                                     "The stage that the program of `exec` replaces. segmenter: the "
                                                     "program separates the person from the background.")
                              .WhenAbsent("(with `exec`: the program replaces the whole capture)")
                              .And("with `exec`"));
    made.check = CheckSeatedMethod;
    return made;
  }();
  return table;
}

Result<void> CheckMarks(const StudioOptions& options, const CaptureMethod& method, const Place& place) {
  if (method.marks != MarkSource::kColours) return {};
  if (options.figure == PerformerFigure::kOwn) {
    return Fail(
        place,
        "'marks: colours' is not allowed with 'figure: own', because the clothes then come from the clip's file");
  }
  if (options.clothes == Clothes::kCoded) return {};
  return Fail(place, "'marks: colours' is allowed only with 'clothes: coded'");
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
    return Fail((named != nullptr ? *named : condition).place, "'rig: file' needs the key '{}' with a calibration file",
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
      return Fail(named->place,
                  "camera '{}' of '{}' takes pictures of {} × {} pixels; allowed: 1 to {} pixels on each side",
                  camera.name, named->scalar, in.width, in.height, kMaxPictureSide);
    }
    const Distortion& lens = camera.camera.distortion;
    if (lens != Distortion{lens.k1, lens.k2, lens.p1, lens.p2, lens.k3}) {
      return Fail(named->place,
                  "camera '{}' of '{}' has a lens model that scenarios cannot use; allowed: the model of Brown and "
                  "Conrady (k1, k2, p1, p2, k3)",
                  camera.name, named->scalar);
    }
    constexpr double kMaxDistance = 100;
    if (const double far = glm::length(camera.camera.p_WC); far > kMaxDistance) {
      return Fail(
          named->place,
          "camera '{}' of '{}' is {:.0f} m from the origin; allowed: at most {:g} m; check that the file is in metres",
          camera.name, named->scalar, far, kMaxDistance);
    }
    own.push_back(camera.camera);
  }
  return {};
}

}  // namespace etude
