#include "bench/tasks/capture/world.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "bench/tasks/base/disguise.h"
#include "sim/camera/lens.h"

namespace etude {
namespace {

// The cameras see the whole body if no joint is farther than this from the middle, along X and along Z; metres.
constexpr double kReach = 1.2;

// A window of a clip, and the movement that brings it to the middle of the floor.
struct Window {
  std::size_t start = 0;
  FloorMove to_origin;
  std::vector<BodyPose> poses;
};

Window MakeWindow(const LibraryClip& clip, std::size_t start, std::size_t frames,
                  const std::optional<Disguise>& disguise) {
  const std::vector<BodyPose>& all = clip.motion.poses;
  Window window;
  window.start = start;
  if (disguise) {
    const bool loops = clip.move && clip.move->loops;
    const double last = loops ? std::numeric_limits<double>::infinity() : static_cast<double>(all.size() - 1);
    for (std::size_t i = 0; i < frames; ++i) {
      window.poses.push_back(PoseOfClip(all, disguise->FrameOf(static_cast<double>(start), 1, i, last)));
    }
    disguise->ApplyTo(window.poses, kJudgedRateHz);
  } else {
    for (std::size_t i = 0; i < frames; ++i) window.poses.push_back(all[(start + i) % all.size()]);
  }
  window.to_origin = ToOrigin(window.poses[frames / 2]);
  for (BodyPose& pose : window.poses) pose = window.to_origin.Apply(pose);
  return window;
}

double FarthestFromMiddle(const std::vector<BodyPose>& poses) {
  double farthest = 0;
  for (const BodyPose& pose : poses) {
    for (const glm::dvec3& joint : pose.joints) farthest = std::max({farthest, std::abs(joint.x), std::abs(joint.z)});
  }
  return farthest;
}

Window ChooseWindow(const StudioOptions& options, const LibraryClip& clip, const WorldKey& key,
                    const std::optional<Disguise>& disguise) {
  RandomStream random(key, "capture/window");
  const std::size_t available = clip.motion.poses.size();
  const bool loops = clip.move && clip.move->loops;
  std::size_t frames = static_cast<std::size_t>(std::lround(options.duration_s * kJudgedRateHz));
  if (!loops) frames = std::min(frames, available);
  const std::size_t starts = loops ? available : available - frames + 1;

  // Take the first random window that stays within reach. If there is none, take the window that exceeds the reach
  // least.
  constexpr int kTries = 12;
  Window best;
  double least = 0;
  for (int i = 0; i < kTries; ++i) {
    Window window = MakeWindow(clip, random.IndexBelow(starts), frames, disguise);
    const double farthest = FarthestFromMiddle(window.poses);
    if (best.poses.empty() || farthest < least) {
      best = std::move(window);
      least = farthest;
    }
    if (least <= kReach) break;
  }
  return best;
}

std::array<Rgb8, 16> ColoursOf(Clothes clothes) {
  if (clothes == Clothes::kCoded) return CodedSuit();
  std::array<Rgb8, 16> colours = PerformerColours();
  if (clothes == Clothes::kStudio) return colours;
  auto dress = [&](std::initializer_list<Part> parts, Rgb8 colour) {
    for (Part part : parts) colours[static_cast<std::size_t>(part)] = colour;
  };
  dress({Part::kTrunk, Part::kLeftUpperArm, Part::kRightUpperArm}, {190, 190, 190});
  dress({Part::kLeftThigh, Part::kLeftShank, Part::kRightThigh, Part::kRightShank}, {35, 45, 80});
  dress({Part::kLeftFoot, Part::kRightFoot}, {50, 45, 45});
  return colours;
}

Wardrobe WardrobeOf(Clothes clothes) {
  switch (clothes) {
    case Clothes::kStudio:
      break;
    case Clothes::kEveryday:
      return Wardrobe::kEveryday;
    case Clothes::kCoded:
      return Wardrobe::kCoded;
  }
  return Wardrobe::kStudio;
}

/// Draws the seed of a picture's room. Recordings contain this seed; in a secret world it has so many bits that nobody
/// can try all seeds.
std::uint64_t DrawRoomSeed(RandomStream& random, const WorldKey& key) {
  return random.IndexBelow(std::uint64_t{1} << (key.suite_seed.IsPlain() ? 30 : 53));
}

StageOptions StageOptionsOf(const StudioOptions& options, const WorldKey& key) {
  RandomStream random(key, "capture/stage");
  return {.seed = DrawRoomSeed(random, key), .scene = options.scene, .wardrobe = WardrobeOf(options.clothes)};
}

// Returns the lamp's brightness per frame. It varies slowly around the brightness of the background pictures.
std::vector<double> MakeBrightness(const StudioOptions& options, std::size_t frames, const WorldKey& key) {
  RandomStream random(key, "capture/light");
  const double period_s = random.Uniform(2, 6), phase = random.Uniform(0, 2 * kPi);
  std::vector<double> brightness;
  for (std::size_t k = 0; k < frames; ++k) {
    const double seconds = static_cast<double>(k) / kJudgedRateHz;
    brightness.push_back(1 + options.light_drift * std::sin(2 * kPi * seconds / period_s + phase));
  }
  return brightness;
}

// A measuring tape. Each measured length has a random error.
class Tape {
 public:
  Tape(double error_mm, const WorldKey& key) : error_m_(0.001 * error_mm), random_(key, "capture/limb-tape") {}

  double Measure(double length) {
    constexpr double kMinLength = 0.01;
    const double measured = length + error_m_ * random_.Normal();
    return length > kMinLength ? std::max(kMinLength, measured) : length;
  }
  /// Returns the measured vector between two positions.
  glm::dvec3 Measure(const glm::dvec3& from_to) {
    const double length = glm::length(from_to), measured = Measure(length);
    return length > 0 ? measured / length * from_to : from_to;
  }

 private:
  const double error_m_;
  RandomStream random_;
};

PersonalLimbs Measured(const PersonalLimbs& person, double error_mm, const WorldKey& key) {
  if (error_mm == 0) return person;
  Tape tape(error_mm, key);
  PersonalLimbs measured = person;
  for (const auto& [name, length] : kLimbLengths) measured.lengths.*length = tape.Measure(person.lengths.*length);
  for (std::size_t i = 1; i < measured.body.joints.size(); ++i) {
    const RestBody::Joint& joint = person.body.joints[i];
    const glm::dvec3& above = measured.body.joints[joint.parent].position;
    measured.body.joints[i].position = above + tape.Measure(joint.position - person.body.joints[joint.parent].position);
  }
  for (RestBody::RoleAnchor& role : measured.body.roles) {
    role.position = measured.body.joints[role.joint].position +
                    tape.Measure(role.position - person.body.joints[role.joint].position);
  }
  return measured;
}

RestBody Scaled(RestBody body, double scale) {
  for (RestBody::Joint& joint : body.joints) joint.position *= scale;
  for (RestBody::RoleAnchor& role : body.roles) role.position *= scale;
  return body;
}

}  // namespace

CaptureWorld MakeStudio(const StudioOptions& options, const FilmedPerson& booking, const WorldKey& key) {
  CaptureWorld world;
  // Make the performer and the light.
  world.person = {booking.lengths, booking.body};
  world.measured = Measured(world.person, options.limb_measure_mm, key);
  world.colours = ColoursOf(options.clothes);
  RandomStream room(key, "capture/room");
  world.room.texture_seed = DrawRoomSeed(room, key);
  world.brightness = MakeBrightness(options, booking.frames, key);
  // Make the cameras with their lenses, and the furnished room.
  world.middle = MiddleOnFloor(booking.poses);
  world.cameras = SetUpCameras(options.rig, booking.poses, key);
  for (std::size_t i = 0; i < world.cameras.size(); ++i) {
    // The user's own cameras keep their lenses, unless the scenario adds a distortion.
    const Distortion wanted = LensOf(options.camera, world.cameras[i], i, key);
    if (!wanted.IsNone()) world.cameras[i].distortion = wanted;
  }
  world.stage_options = StageOptionsOf(options, key);
  world.stage = StagedRoom(world.stage_options, booking.poses, world.cameras);
  return world;
}

CaptureWorld MakeCaptureWorld(const StudioOptions& options, const LibraryClip& clip, const WorldKey& key) {
  // In a secret world, disguise the clip, unless its own mesh is drawn: the mesh moves exactly like the clip.
  std::optional<Disguise> disguise;
  if (!key.suite_seed.IsPlain() && options.figure != PerformerFigure::kOwn) disguise.emplace(key);
  Window window = ChooseWindow(options, clip, key, disguise);
  std::vector<BodyPose>& truth = window.poses;
  RestBody body = clip.body.joints.empty() ? RestBodyOf(truth) : clip.body;
  if (disguise && !clip.body.joints.empty()) body = Scaled(std::move(body), disguise->scale());
  CaptureWorld world = MakeStudio(options, {truth, body, MeasureLimbLengths(truth), truth.size()}, key);
  if (options.figure == PerformerFigure::kOwn) world.own = {clip.figure, window.start, window.to_origin};
  world.truth = std::move(truth);
  world.in_view = FramesInView(world.cameras, world.truth);
  return world;
}

Distortion LensOf(const CameraEffects& effects, const Camera& camera, std::size_t index, const WorldKey& key) {
  RandomStream random(key, fmt::format("capture/camera-{}/lens", index));
  return LensDistortion(effects, camera.intrinsics, random);
}

FrameMeasurement TrueMeasurement(const BodyPose& truth) {
  FrameMeasurement frame;
  for (const EffectorMark& mark : EffectorMarks()) frame.ends[Index(mark.role)] = truth[mark.role];
  for (const StrokeMark& mark : StrokeMarks()) {
    const glm::dvec3 limb = truth[mark.to] - truth[mark.from];
    if (glm::length(limb) > 0) frame.directions[Index(mark.to)] = glm::normalize(limb);
  }
  return frame;
}

}  // namespace etude
