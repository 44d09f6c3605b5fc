#include <etude/silhouettes.h>
#include <etude/vision.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <optional>

#include "python/engine/arrays.h"

namespace etude::engine {
namespace {

using Bytes = py::array_t<std::uint8_t, py::array::c_style>;

std::string ShapeTextOf(const py::array& array) { return ShapeText({array.shape(), array.shape() + array.ndim()}); }

constexpr py::ssize_t kMaxSide = 8192;

int Side(py::ssize_t length) {
  if (length >= 1 && length <= kMaxSide) return static_cast<int>(length);
  throw BadInput(fmt::format("a side of {} pixels; allowed: 1 to {}", length, kMaxSide));
}

ColourImage ToPicture(const char* name, const Bytes& picture, py::ssize_t height, py::ssize_t width) {
  const bool fits = picture.ndim() == 3 && picture.shape(2) == 3 && (height == kAny || picture.shape(0) == height) &&
                    (width == kAny || picture.shape(1) == width);
  if (!fits) {
    throw BadInput(std::string(name) + ": has the shape " + ShapeTextOf(picture) +
                   ", allowed: " + ShapeText({height, width, 3}));
  }
  ColourImage image(Side(picture.shape(1)), Side(picture.shape(0)));
  static_assert(sizeof(Rgb8) == 3);
  std::memcpy(image.pixels.data(), picture.data(), static_cast<std::size_t>(picture.size()));
  return image;
}

/// A PersonFinder, and the size of the masks that it finds.
struct Finder {
  PersonFinder finder;
  int height, width;
};

Finder MakeFinder(const Bytes& background, const std::string& segmenter, bool all_pieces) {
  const ColourImage room = ToPicture("background", background, kAny, kAny);
  const std::vector<std::string> names = SegmenterNames();
  if (std::ranges::find(names, segmenter) == names.end()) {
    throw BadInput(fmt::format("no segmenter '{}'; allowed: {}", segmenter, fmt::join(names, ", ")));
  }
  PersonOptions options{.segmenter = SegmenterNamed(segmenter), .change = {}};
  options.pieces = all_pieces ? PersonPieces::kLarge : PersonPieces::kLargest;
  return {PersonFinder(room, options), room.height, room.width};
}

py::array_t<bool> FindIn(Finder& finder, const Bytes& bytes) {
  const ColourImage picture = ToPicture("picture", bytes, finder.height, finder.width);
  const Mask mask = Unlocked([&] { return finder.finder.Find(picture); });
  py::array_t<bool> found({finder.height, finder.width});
  std::ranges::transform(mask.pixels, found.mutable_data(), [](std::uint8_t value) { return value != 0; });
  return found;
}

using Masks = py::array_t<bool, py::array::c_style | py::array::forcecast>;

Mask MaskOf(const bool* pixels, py::ssize_t height, py::ssize_t width) {
  if (std::min(width, height) < 1 || std::max(width, height) > kMaxSide) {
    throw BadInput(
        fmt::format("the mask has {} x {} pixels; allowed: 1 to {} pixels on each side", width, height, kMaxSide));
  }
  Mask mask(static_cast<int>(width), static_cast<int>(height));
  std::copy_n(pixels, mask.pixels.size(), mask.pixels.begin());
  return mask;
}

Mask OneMask(const Masks& mask) {
  if (mask.ndim() != 2) throw BadInput("mask: has the shape " + ShapeTextOf(mask) + ", allowed: (any, any)");
  return MaskOf(mask.data(), mask.shape(0), mask.shape(1));
}

py::tuple OutlineOf(const Masks& masked, int spacing, double thinnest) {
  const Mask mask = OneMask(masked);
  if (spacing < 1 || spacing > 1000 || !(thinnest >= 0 && thinnest <= 100)) {
    throw BadInput(fmt::format("spacing {}, thinnest {}; allowed: 1 to 1000, 0 to 100", spacing, thinnest));
  }
  const Silhouette found = Unlocked([&] { return MakeSilhouette(mask, {.spacing = spacing, .thinnest = thinnest}); });
  std::vector<glm::dvec2> pixels, normals;
  for (const OutlinePoint& point : found.outline) {
    pixels.push_back(point.pixel);
    normals.push_back(point.normal);
  }
  return py::make_tuple(ToArrays(pixels), ToArrays(normals));
}

py::array_t<float> DistancesOf(const Masks& masked) {
  const Mask mask = OneMask(masked);
  const Image<float> distances = Unlocked([&] { return SignedDistances(mask); });
  return py::array_t<float>({distances.height, distances.width}, distances.pixels.data());
}

Array TrackAll(const std::vector<NamedCamera>& cameras, const std::vector<Masks>& masks, double stature_m,
               const std::optional<BodyMotion>& measured, double rate_hz) {
  std::vector<std::vector<Mask>> told;
  for (const Masks& film : masks) {
    if (film.ndim() != 3)
      throw BadInput("masks: one has the shape " + ShapeTextOf(film) + ", allowed: (any, any, any)");
    std::vector<Mask>& frames = told.emplace_back();
    for (py::ssize_t i = 0; i < film.shape(0); ++i) {
      frames.push_back(MaskOf(film.data() + i * film.shape(1) * film.shape(2), film.shape(1), film.shape(2)));
    }
  }
  FollowOptions options{.stature_m = stature_m, .measured = {}, .rate_hz = rate_hz};
  if (measured) {
    if (measured->poses.empty()) throw BadInput("measured: has no frames");
    options.measured = measured->poses;
  }
  BodyPose unknown;
  unknown.joints.fill(glm::dvec3(kNan));
  std::vector<BodyPose> poses;
  for (const auto& pose : Unlocked([&] { return TrackSilhouettes(cameras, told, options); })) {
    poses.push_back(pose.value_or(unknown));
  }
  return ToArrays(poses);
}

}  // namespace

void AddVision(py::module_& module) {
  py::class_<Finder>(module, "PersonFinder", "Cuts the person out of one camera's pictures, one after the other.")
      .def(py::init(&MakeFinder), "background"_a, "segmenter"_a = "hue-gated", "all_pieces"_a = false,
           "background: the empty room, height x width x 3 of uint8, red, green, blue. segmenter: 'hue-gated', 'rgb', "
           "'hue', 'ratio', 'running', 'likelihood'. all_pieces: of what changed, every piece of some size near the "
           "largest.")
      .def("find", &FindIn, "picture"_a, "The mask (height x width, bool) of the next picture.");
  module.def(
      "outline", &OutlineOf, "mask"_a, "spacing"_a = SilhouetteOptions{}.spacing,
      "thinnest"_a = SilhouetteOptions{}.thinnest,
      "(n x 2 pixels, n x 2 unit normals out of the person) along the rim of a mask (height x width, bool), from "
      "its top; the first pixel's centre is (0.5, 0.5). spacing: one point in every square of so many pixels, 1 "
      "to 1000. thinnest: what is thinner than twice so many pixels is no part of the person, 0 to 100. Raises "
      "BadInput for another shape, sides that are not from 1 to 8192, and numbers out of range.");
  module.def("signed_distances", &DistancesOf, "mask"_a,
             "How far each pixel's centre is from the rim of a mask (height x width, bool): height x width of float32, "
             "pixels, positive outside. Raises BadInput as `outline`.");
  module.def(
      "track_silhouettes", &TrackAll, "cameras"_a, "masks"_a, "stature_m"_a = FollowOptions{}.stature_m,
      "measured"_a = py::none(), "rate_hz"_a = FollowOptions{}.rate_hz,
      "Where the joints of a person are (frames x 20 x 3, metres, in the order of ROLES), by nothing but the "
      "outlines; NaN in frames in which fewer than two cameras show anybody. cameras: two or more that stand "
      "still, pinholes. masks: of each camera, frames x height x width of bool, of the camera's size or smaller "
      "by one whole factor. stature_m: of an average adult, 0.5 to 2.5; or measured: a Motion of this person, of "
      "which limb lengths are taken. Raises BadInput for cameras and masks that do not fit each other, and for lenses "
      "with distortion.");
}

}  // namespace etude::engine
