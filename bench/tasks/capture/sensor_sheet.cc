#include "bench/tasks/capture/exchange.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/tasks/capture/shooting.h"

namespace etude {
namespace {

/// The part of the picture that shows an effect best.
enum class Detail {
  kWhole,     ///< the whole picture
  kDetail,    ///< the head, enlarged: effects at the scale of pixels
  kPerson,    ///< the part around the person
  kWithTruth  ///< the part around the person, with the true skeleton
};

struct ShownEffect {
  const char* title;
  double CameraEffects::*strength;
  std::array<double, 3> strengths;
  const char* unit;
  Detail detail;
};

std::vector<ShownEffect> ShownEffects() {
  using E = CameraEffects;
  return {
      // Each entry has a caption, an effect, three strengths, a unit, and the part of the picture that is shown.
      {"Sync offset (all cameras but the first); true skeleton over it",
       &E::sync_offset_ms,
       {20, 60, 150},
       " ms",
       Detail::kWithTruth},
      {"Clock drift (all cameras but the first); true skeleton over it",
       &E::clock_drift_ppm,
       {5000, 20000, 50000},
       " ppm",
       Detail::kWithTruth},
      {"Rolling shutter; true skeleton over it", &E::rolling_shutter_ms, {10, 30, 60}, " ms", Detail::kWithTruth},
      {"Motion blur, share of a frame", &E::motion_blur, {0.25, 0.5, 1}, "", Detail::kPerson},
      {"Radial distortion, of the corner", &E::radial_distortion, {-0.12, -0.05, 0.15}, "", Detail::kWhole},
      {"Tangential distortion, of the corner", &E::tangential_distortion, {0.01, 0.025, 0.05}, "", Detail::kWhole},
      {"Defocus", &E::defocus_px, {0.7, 1.5, 4}, " px", Detail::kDetail},
      {"Vignette, natural = 1", &E::vignette, {0.5, 1, 2.5}, "", Detail::kWhole},
      {"Dust, share of light blocked", &E::dust, {0.15, 0.4, 0.9}, "", Detail::kWhole},
      // Effects of the sensor and of its picture file.
      {"Exposure", &E::exposure_ev, {-1.5, -0.5, 1}, " EV", Detail::kWhole},
      {"Drift of the exposure, at this moment", &E::exposure_drift_ev, {0.2, 0.6, 1.5}, " EV", Detail::kWhole},
      {"Gain: less light, amplified", &E::gain_db, {6, 15, 30}, " dB", Detail::kDetail},
      {"White balance, red against blue", &E::white_balance_ev, {-0.8, 0.4, 1.2}, " EV", Detail::kWhole},
      {"Drift of the white balance, at this moment", &E::white_balance_drift_ev, {0.2, 0.6, 1.5}, " EV", Detail::kWhole},
      {"Bayer mosaic, bilinear demosaicing", &E::bayer, {0, 0.5, 1}, "", Detail::kDetail},
      {"Shot and read noise, usual = 1", &E::noise, {0, 1, 4}, "", Detail::kDetail},
      {"JPEG, 100 − quality", &E::jpeg_loss, {25, 70, 95}, "", Detail::kDetail},
  };
}

constexpr std::size_t kShownCameras = 2;

Rgb8 ColourOfLabel(std::uint32_t label) {
  if (label == 0) return {24, 26, 30};
  if (label == 1) return {60, 64, 72};
  // Successive labels differ by the golden angle in hue, so that neighbouring labels have distinct colours.
  const double hue = std::fmod(label * 0.381966, 1.0) * 6;
  const auto channel = [&](double shift) {
    const double distance = std::abs(std::fmod(hue + shift, 6.0) - 3) - 1;
    return static_cast<std::uint8_t>(70 + 170 * std::clamp(distance, 0.0, 1.0));
  };
  return {channel(0), channel(4), channel(2)};
}

ColourImage PictureOfLabels(const LabelImage& labels) {
  ColourImage picture(labels.width, labels.height);
  std::ranges::transform(labels.pixels, picture.pixels.begin(), ColourOfLabel);
  return picture;
}

/// Returns the depth as a grey picture, linear in 1 / depth: the nearest point is white, the farthest black.
ColourImage PictureOfDepth(const DepthImage& depth) {
  float least = 0, most = 0;
  for (const float metres : depth.pixels) {
    if (!std::isfinite(metres)) continue;
    most = std::max(most, 1 / metres);
    least = least == 0 ? 1 / metres : std::min(least, 1 / metres);
  }
  ColourImage picture(depth.width, depth.height);
  std::ranges::transform(depth.pixels, picture.pixels.begin(), [&](float metres) {
    const float share = most > least ? (1 / metres - least) / (most - least) : 0;
    const auto grey = static_cast<std::uint8_t>(255 * std::clamp(share, 0.0f, 1.0f));
    return Rgb8{grey, grey, grey};
  });
  return picture;
}

std::vector<SheetMark> PictureOfMarks(const Marks& marks) {
  std::vector<SheetMark> shown;
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (marks.strokes[i]) shown.push_back({marks.strokes[i]->a, marks.strokes[i]->b, StrokeMarks()[i].first_half});
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    if (marks.effectors[i]) shown.push_back({*marks.effectors[i], *marks.effectors[i], EffectorMarks()[i].colour});
  }
  return shown;
}

std::vector<SheetMark> Skeleton(const BodyPose& pose, const Camera& camera) {
  std::vector<SheetMark> lines;
  for (const Bone& bone : AllBones()) {
    const auto from = Project(camera, pose[bone.parent]), to = Project(camera, pose[bone.child]);
    if (from && to) lines.push_back({*from, *to, {90, 255, 150}});
  }
  return lines;
}

/// The size of a part that is cut out around a position, in pixels. The part is moved inwards if it would leave the
/// picture. Each pixel is enlarged `times` times.
struct Cutting {
  int width, height, times;
};
constexpr Cutting kHeadPart{80, 60, 3}, kPersonPart{320, 240, 1};

SheetPicture Cut(const SheetPicture& whole, const glm::dvec2& centre, const Cutting& part) {
  const ColourImage& from = whole.picture;
  const int width = std::min(part.width, from.width), height = std::min(part.height, from.height);
  const int left = std::clamp(static_cast<int>(centre.x) - width / 2, 0, from.width - width);
  const int top = std::clamp(static_cast<int>(centre.y) - height / 2, 0, from.height - height);
  SheetPicture cut{whole.caption, ColourImage(part.times * width, part.times * height), whole.marks};
  for (int y = 0; y < cut.picture.height; ++y) {
    for (int x = 0; x < cut.picture.width; ++x) {
      cut.picture.At(x, y) = from.At(left + x / part.times, top + y / part.times);
    }
  }
  for (SheetMark& mark : cut.marks) {
    for (glm::dvec2* end : {&mark.a, &mark.b}) *end = static_cast<double>(part.times) * (*end - glm::dvec2(left, top));
  }
  return cut;
}

/// Returns the index of the frame in which the body moves fastest.
std::size_t LiveliestFrame(const std::vector<BodyPose>& poses) {
  std::size_t liveliest = 0;
  double most = -1;
  for (std::size_t k = 1; k + 1 < poses.size(); ++k) {
    double way = 0;
    for (const Role role : AllRoles()) way += glm::length(poses[k + 1][role] - poses[k - 1][role]);
    if (way > most) liveliest = k;
    most = std::max(way, most);
  }
  return liveliest;
}

class SheetMaker {
 public:
  SheetMaker(const StudioOptions& options, const WorldKey& key, const CaptureWorld& world, Renderer& renderer)
      : options_(options), key_(key), world_(world), renderer_(renderer), frame_(LiveliestFrame(world.truth)) {
    world_.cameras.resize(std::min(kShownCameras, world_.cameras.size()));
  }

  std::size_t frame() const { return frame_; }

  SheetRow AsItIs(const Take& take, std::size_t camera) const {
    const View view = Shoot(options_.camera, camera);
    SheetRow row{fmt::format("Camera {}, as in the scenario", camera + 1), {}};
    row.pictures = {{"picture", view.colour, {}},
                    {"labels", PictureOfLabels(view.labels), {}},
                    {"depth: white is nearest", PictureOfDepth(view.depth), {}}};
    // Show the marks only if the annotator marked this frame.
    const std::vector<Marks>& marks = take.observations.front().marks[camera];
    const auto step = static_cast<std::size_t>(options_.mark_every);
    if (frame_ % step == 0) {
      const SheetPicture marked{"the annotator's marks", view.colour, PictureOfMarks(marks[frame_])};
      row.pictures.push_back(Cut(marked, PixelOf(Role::kHipCentre, camera), kPersonPart));
    }
    return row;
  }

  SheetRow Of(const ShownEffect& effect) const {
    SheetRow row{effect.title, {}};
    for (std::size_t camera = 0; camera < world_.cameras.size(); ++camera) {
      for (const double strength : effect.strengths) {
        CameraEffects effects = options_.camera;
        effects.*effect.strength = strength;
        ColourImage seen = Shoot(effects, camera).colour;
        SheetPicture shown{fmt::format("camera {}: {:g}{}", camera + 1, strength, effect.unit), std::move(seen), {}};
        if (effect.detail == Detail::kWithTruth) shown.marks = Skeleton(world_.truth[frame_], world_.cameras[camera]);
        if (effect.detail == Detail::kDetail) shown = Cut(shown, PixelOf(Role::kHead, camera), kHeadPart);
        if (effect.detail == Detail::kPerson || effect.detail == Detail::kWithTruth) {
          shown = Cut(shown, PixelOf(Role::kHipCentre, camera), kPersonPart);
        }
        row.pictures.push_back(std::move(shown));
      }
    }
    return row;
  }

 private:
  glm::dvec2 PixelOf(Role role, std::size_t camera) const {
    const Intrinsics& in = world_.cameras[camera].intrinsics;
    return Project(world_.cameras[camera], world_.truth[frame_][role]).value_or(glm::dvec2(in.cx, in.cy));
  }

  View Shoot(const CameraEffects& effects, std::size_t camera) const {
    CaptureWorld world = world_;
    for (std::size_t i = 0; i < world.cameras.size(); ++i) {
      world.cameras[i].distortion = LensOf(effects, world.cameras[i], i, key_);
    }
    return Shooting(world, effects, key_, renderer_).Shoot(camera, frame_, Targets::kAll);
  }

  const StudioOptions& options_;
  const WorldKey& key_;
  CaptureWorld world_;
  Renderer& renderer_;
  std::size_t frame_;
};

}  // namespace

Result<SensorSheet> MakeCaptureSheet(const StudioOptions& options, const WorldKey& key, CaptureStages& stages) {
  ASSIGN_OR_RETURN(const auto take, stages.GetTake());
  ASSIGN_OR_RETURN(const auto renderer, stages.GetRenderer());
  const SheetMaker maker(options, key, stages.world(), *renderer);
  SensorSheet sheet{fmt::format("{}, trial {}, frame {}", key.scenario, key.trial + 1, maker.frame()), {}};
  for (std::size_t i = 0; i < std::min(kShownCameras, stages.world().cameras.size()); ++i) {
    sheet.rows.push_back(maker.AsItIs(*take, i));
  }
  for (const ShownEffect& effect : ShownEffects()) sheet.rows.push_back(maker.Of(effect));
  return sheet;
}

}  // namespace etude
