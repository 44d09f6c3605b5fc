#include "bench/tasks/capture/options.h"

#include <algorithm>

#include "engine/cameras/rig_file.h"
#include "sim/render/scene.h"

namespace etude {
namespace {

Field<StudioOptions> Effect(const std::string& key, double CameraEffects::*effect, Range range, std::string meaning) {
  return Field<StudioOptions>::Number(key, Path(&StudioOptions::camera, effect), range, std::move(meaning));
}

/// The keys of what the cameras do to the light: one per effect of CameraEffects, in their order.
std::vector<Field<StudioOptions>> CameraFields() {
  using E = CameraEffects;
  return {
      Effect("sync_offset_ms", &E::sync_offset_ms, {0, 500},
             "How far the clocks of all cameras but the first stand off, either way."),
      Effect("clock_drift_ppm", &E::clock_drift_ppm, {0, 50000},
             "How much faster or slower those clocks run, millionths."),
      Effect("rolling_shutter_ms", &E::rolling_shutter_ms, {0, 66},
             "From the reading of a picture's first row to that of its last."),
      Effect("motion_blur", &E::motion_blur, {0, 1},
             "How long the shutter is open, as a share of the time between frames."),
      Effect("radial_distortion", &E::radial_distortion, {-0.12, 0.25},
             "How far the lens moves the picture's corner, of its distance from the middle; below 0 a barrel."),
      Effect("tangential_distortion", &E::tangential_distortion, {0, 0.05},
             "Likewise, of a lens that is not parallel to the sensor."),
      Effect("defocus_px", &E::defocus_px, {0, 10}, "Standard deviation of the Gaussian that a point is spread to."),
      Effect("vignette", &E::vignette, {0, 4},
             "Darkness of the corners: 1 is natural, the cosine of the angle from the axis to the fourth power."),
      Effect("dust", &E::dust, {0, 1}, "The share of the light that a speck of dust keeps away, in its middle."),
      Effect("exposure_ev", &E::exposure_ev, {-4, 4}, "Stops by which pictures are too bright."),
      Effect("exposure_drift_ev", &E::exposure_drift_ev, {0, 2},
             "How far an automatic exposure wanders, stops at most."),
      Effect("gain_db", &E::gain_db, {0, 36}, "Amplification: as bright a picture of less light, with more noise."),
      Effect("white_balance_ev", &E::white_balance_ev, {-2, 2}, "Stops of red against blue: above 0 too warm."),
      Effect("white_balance_drift_ev", &E::white_balance_drift_ev, {0, 2},
             "How far an automatic white balance wanders, stops at most."),
      Effect("bayer", &E::bayer, {0, 1},
             "1: each pixel measures one colour, the others are interpolated; between, a mix of both pictures."),
      Effect("camera_noise", &E::noise, {0, 20}, "Multiplies the camera's usual noise."),
      Effect("jpeg_loss", &E::jpeg_loss, {0, 99}, "100 less the quality of the JPEG file; 0 is no JPEG.")};
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
       Key::Name(
           "rig", Path(&Options::rig, &RigOptions::shape),
           {{"angles", RigShape::kAngles},
            {"stereo", RigShape::kStereo},
            {"ring", RigShape::kRing},
            {"corners", RigShape::kCorners},
            {"file", RigShape::kFile}},
           "How the cameras stand about the performer: at given angles, side by side in front, evenly around, in four "
           "corners, or as your own were calibrated."),
       Key{{kRigFileKey, FileKind("a calibration file"), "(none)",
            "Your own cameras, two to eight: what `etude calibrate` writes, OpenCV's YAML, Pose2Sim's or Anipose's "
            "TOML, "
            "Qualisys' XML. The rig is moved as a whole to where the performer is."},
           [](Fields& condition, Options&) { condition.Raw(kRigFileKey); }}
           .With("rig", {"file"}),
       Key::Numbers("camera_angles_deg", Path(&Options::rig, &RigOptions::angles_deg), {2, kMaxCameras},
                    "two to eight of -180…180", {-180, 180},
                    "Where they stand: 0 = in front, positive = to the performer's left.")
           .With("rig", {"angles"}),
       Key::Number("camera_baseline_m", Path(&Options::rig, &RigOptions::baseline_m), {0.05, 3},
                   "From one to the other.")
           .With("rig", {"stereo"}),
       Key::Number("cameras", Path(&Options::rig, &RigOptions::cameras), {2, kMaxCameras}, "How many stand around.")
           .With("rig", {"ring"}),
       Key::Numbers("camera_heights_m", Path(&Options::rig, &RigOptions::heights_m), {1, kMaxCameras},
                    "one to eight of 0.2…5", {0.2, 5},
                    "How high they stand: one for each angle; in other rigs the cameras take them in turn."),
       Key::Number("camera_distance_m", Path(&Options::rig, &RigOptions::distance_m), {2, 10},
                   "From the middle of where the performer moves, as far as the room allows."),
       Key::Name(
           "figure", &Options::figure, {{"staged", PerformerFigure::kStaged}, {"own", PerformerFigure::kOwn}},
           "Who is drawn: the stage's own people, or the meshes and textures that the clips' files bring (glTF)."),
       Key::Name("clothes", &Options::clothes,
                 {{"studio", Clothes::kStudio}, {"everyday", Clothes::kEveryday}, {"coded", Clothes::kCoded}},
                 "Of the stage's people: colours that stand apart from the room's; a grey shirt and trousers of the "
                 "floor's hue; or a suit of which every limb has a colour of its own."),
       Key::Number(
           "scene", &Options::scene, {0, 1},
           "How much a room people live in: 0 = the studio, 1 = furniture, clutter, a second person, hues alike."),
       Key::Number("light_drift", &Options::light_drift, {0, 0.5}, "Largest relative change of the lamp's brightness."),
       Key::Name(
           "calibration_target", &Options::calibration_target,
           {{"points", CalibrationTargetKind::kPoints},
            {"marks", CalibrationTargetKind::kMarks},
            {"boards", CalibrationTargetKind::kBoards}},
           "What the cameras are calibrated with: points on planes, clicked by a human; discs on the planes of a cube, "
           "clicked and then found in a picture; or a cube of coded boards that is found in a picture."),
       Key::Number("calibration_pairs", &Options::calibration_pairs, {6, 1000}, "Clicked points per camera.")
           .With("calibration_target", {"points"}),
       Key::Number(
           "calibration_measure_mm", &Options::calibration_measure_mm, {0, 100},
           "Standard deviation of the target's measured places, along each axis: of a point, a mark or a board."),
       Key::Number("calibration_noise_px", &Options::calibration_noise_px, {0, 20},
                   "Standard deviation of a click on a calibration point or mark, in u and in v.")
           .With("calibration_target", {"points", "marks"}),
       Key::Number(
           "annotation_error_px", &Options::annotation_error_px, {0, 50},
           "Standard deviation of an annotator's marks, in u and in v; what else people get wrong grows with it."),
       Key::Number("limb_measure_mm", &Options::limb_measure_mm, {0, 100},
                   "Error of the performer's measured limbs, standard deviation of each length."),
       Key::Number("annotators", &Options::annotators, {1, 2},
                   "How many people mark the same pictures, each by themselves; methods get the mean of both."),
       Key::Number("mark_every", &Options::mark_every, {1, 300},
                   "The annotator marks every n-th frame; what lies between is interpolated."),
       Key::Numbers(
           "moments", &Options::moments, {0, 12}, "up to twelve of 1…1800", {1, 1800},
           "Frames, counted from 1, of which the report shows every stage, as figures 5.3 to 5.14 of paper B do.")},
      CheckStudio};
  Append(CameraFields(), made.fields);
  return made;
}

void CheckMethod(Fields& fields, CaptureMethod& method) {
  const Oracle& oracle = method.oracle;
  if (method.recovery == Recovery::kKeypoints) {
    method.lengths = LengthSource::kMeasured;  // it uses no others
    if (oracle.lengths)
      fields.Complain(fields.Raw("oracle")->place, "'recovery: keypoints' measures the lengths itself");
  }
  if (method.marks == MarkSource::kColours && oracle.marks) {
    fields.Complain(fields.Raw("oracle")->place,
                    "the oracle marks and 'marks: colours' do not go together: both say who marks the pictures");
  }
  // Silhouettes use marks only with `start: keypoints`.
  if (method.recovery == Recovery::kSilhouettes) {
    const bool has_marks = method.start == SilhouetteStart::kKeypoints;
    if (!has_marks && (oracle.marks || method.lengths == LengthSource::kMeasured)) {
      fields.Complain(fields.node().place,
                      "'recovery: silhouettes' has no marks without 'start: keypoints': neither the oracle marks, nor "
                      "lengths measured from them");
    }
    if (has_marks && method.causal) {
      fields.Complain(fields.Raw("causal")->place, "'start: keypoints' follows the whole take, not picture by picture");
    }
  }
  // A causal method may not use what depends on the whole take.
  const bool knows_all =
      method.smoothing != Smoothing::kNone || method.sync != Sync::kAssumed || method.lengths != LengthSource::kKnown;
  if (method.causal && knows_all) {
    fields.Complain(fields.Raw("causal")->place,
                    "'causal: true' and smoothing, measured lengths or estimated clocks do not go together: these come "
                    "of the whole take");
  }
  if (method.recovery == Recovery::kIk || !(oracle.directions || oracle.points || oracle.start || oracle.ik)) return;
  fields.Complain(fields.Raw("oracle")->place,
                  "only 'recovery: ik' has the stages directions, points, start and ik: others see the pictures alone");
}

void CheckSeatedMethod(Fields& fields, CaptureMethod& method) {
  CheckMethod(fields, method);
  if (method.seat != CaptureSeat::kSegmenter) return;
  if (const Node* segmenter = fields.node().Find("segmenter")) {
    fields.Complain(segmenter->place, "'segmenter' is what the program in that seat does");
  }
  if (method.oracle.segmentation) {
    fields.Complain(fields.Raw("oracle")->place, "segmentation is what the program in that seat does");
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
        {Key::Name("segmenter", &Method::segmenter, SegmenterNames(), SegmenterNamed,
                   "How the person is cut out of the pictures."),
         Key::Name("pieces", &Method::pieces, {{"largest", PersonPieces::kLargest}, {"large", PersonPieces::kLarge}},
                   "Which pieces of what changed are the person: the largest alone (paper B), or every one of some "
                   "size beside it, too.")
             .With("recovery", {"ik", "ends", "bundle", "keypoints"}),
         Key::Name("marks", &Method::marks, {{"annotator", MarkSource::kAnnotator}, {"colours", MarkSource::kColours}},
                   "Who marks the limbs: the annotator, or nobody: the colours of a suit tell them apart. Colours need "
                   "`clothes: coded`.")
             .With("recovery", {"ik", "ends", "bundle", "keypoints"}),
         Key::Name("calibration", &Method::calibration, CalibrationNames(), CalibrationNamed,
                   "How a camera is computed from its calibration points."),
         Key::Name("sync", &Method::sync, {{"assumed", Sync::kAssumed}, {"estimated", Sync::kEstimated}},
                   "Whether the cameras' clocks are taken to agree, or set by how marks move."),
         Key::Name("outliers", &Method::outliers, {{"keep", OutlierRule::kKeep}, {"reject", OutlierRule::kReject}},
                   "With three or more cameras: whether one that disagrees with the others about a mark is left out."),
         Key::Name("body", &Method::body, {{"fitted", BodyKind::kFitted}, {"paper", BodyKind::kPaper}},
                   "The performer's own joints, or paper B's 29 degrees of freedom.")
             .With("recovery", {"ik"}),
         Key::Name(
             "recovery", &Method::recovery,
             {{"ik", Recovery::kIk},
              {"ends", Recovery::kEnds},
              {"bundle", Recovery::kBundle},
              {"keypoints", Recovery::kKeypoints},
              {"silhouettes", Recovery::kSilhouettes}},
             "How pictures become poses: paper B's inverse kinematics; every joint triangulated from the strokes that "
             "end there; bundle adjustment of paper B's body over the whole take; what `etude capture` makes of marks, "
             "a "
             "body of their own lengths fitted to all of them; or, without a mark, a body fitted to the silhouettes."),
         Key::Name(
             "start", &Method::start,
             {{"cold", SilhouetteStart::kCold},
              {"near", SilhouetteStart::kNear},
              {"keypoints", SilhouetteStart::kKeypoints}},
             "What is known beside the outlines: nothing; every angle of the first frame's pose to 10°; or in every "
             "picture where joints are, as marks say, which stand for an estimator's keypoints.")
             .With("recovery", {"silhouettes"}),
         Key::Name("smoothing", &Method::smoothing, {{"none", Smoothing::kNone}, {"rts", Smoothing::kRts}},
                   "What is done to the joints of the whole take afterwards: nothing, or Rauch, Tung and Striebel's "
                   "smoother.")
             .With("recovery", {"ik", "ends", "bundle"}),
         Key::Name("lengths", &Method::lengths,
                   {{"known", LengthSource::kKnown}, {"measured", LengthSource::kMeasured}},
                   "Whether the body is measured beforehand, or its limb lengths from the marks of a few frames.")
             .With("recovery", {"ik", "ends", "bundle", "silhouettes"}),
         Key::Flag("causal", &Method::causal,
                   "Whether each frame's skeleton comes of the pictures up to it alone, as a live system must have it.")
             .With("recovery", {"ik", "silhouettes"}),
         ToleranceField(&Method::ik, "How far an angle may leave the one seen in the images.").With("recovery", {"ik"}),
         SweepsField(&Method::ik, "The solver's steps per frame, at most.").With("recovery", {"ik"}),
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
                                                     "What the program of `exec` does: it cuts out the person.")
                              .WhenAbsent("(the whole capture, where there is an `exec`)")
                              .And("with `exec`"));
    made.check = CheckSeatedMethod;
    return made;
  }();
  return table;
}

Result<void> CheckMarks(const StudioOptions& options, const CaptureMethod& method, const Place& place) {
  if (method.marks != MarkSource::kColours) return {};
  if (options.figure == PerformerFigure::kOwn) {
    return Fail(place, "'marks: colours' cannot read 'figure: own', whose clothes are the file's");
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
  // The key `rig_file` must name a file that is among the condition's texts.
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
                  "camera '{}' of '{}' has a lens of another model; allowed in scenarios: Brown and Conrady's (k1, k2, "
                  "p1, p2, k3)",
                  camera.name, named->scalar);
    }
    constexpr double kMaxDistance = 100;
    if (const double far = glm::length(camera.camera.p_WC); far > kMaxDistance) {
      return Fail(named->place, "camera '{}' of '{}' is {:.0f} m away; allowed: {:g}. Is the file in metres?",
                  camera.name, named->scalar, far, kMaxDistance);
    }
    own.push_back(camera.camera);
  }
  return {};
}

}  // namespace etude
