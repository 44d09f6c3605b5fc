#include <etude/silhouettes.h>
#include <etude/vision.h>

#include <cstdint>
#include <optional>

#include "python/engine/arrays.h"

namespace etude::engine {
namespace {

using Bytes = py::array_t<std::uint8_t, py::array::c_style>;

std::string ShapeTextOf(const py::array& array) { return ShapeText({array.shape(), array.shape() + array.ndim()}); }

std::span<const std::uint8_t> PictureOf(const char* name, const Bytes& picture, py::ssize_t height, py::ssize_t width) {
  const bool fits = picture.ndim() == 3 && picture.shape(2) == 3 && (height == kAny || picture.shape(0) == height) &&
                    (width == kAny || picture.shape(1) == width);
  if (!fits) {
    throw BadInput(std::string(name) + ": has the shape " + ShapeTextOf(picture) +
                   ", allowed: " + ShapeText({height, width, 3}));
  }
  return {picture.data(), static_cast<std::size_t>(picture.size())};
}

/// A PersonFinder and the size of its masks.
struct Finder {
  PersonFinder finder;
  py::ssize_t height, width;
};

Finder MakeFinder(const Bytes& background, const std::string& segmenter, bool all_pieces) {
  const auto bytes = PictureOf("background", background, kAny, kAny);
  constexpr py::ssize_t kMaxSize = 1 << 20;  // more than the engine accepts
  const int height = static_cast<int>(std::min(background.shape(0), kMaxSize));
  const int width = static_cast<int>(std::min(background.shape(1), kMaxSize));
  return {PersonFinder(bytes, width, height, {.segmenter = segmenter, .all_pieces = all_pieces}), background.shape(0),
          background.shape(1)};
}

py::array_t<bool> FindIn(Finder& finder, const Bytes& picture) {
  const auto bytes = PictureOf("picture", picture, finder.height, finder.width);
  std::vector<std::uint8_t> mask;
  {
    const py::gil_scoped_release free;
    mask = finder.finder.Find(bytes);
  }
  py::array_t<bool> found({finder.height, finder.width});
  std::ranges::transform(mask, found.mutable_data(), [](std::uint8_t value) { return value != 0; });
  return found;
}

using Masks = py::array_t<bool, py::array::c_style | py::array::forcecast>;

PersonMask MaskOf(const bool* pixels, py::ssize_t height, py::ssize_t width) {
  constexpr py::ssize_t kMaxSize = 1 << 20;  // more than the engine accepts
  PersonMask mask{.width = static_cast<int>(std::min(width, kMaxSize)),
                  .height = static_cast<int>(std::min(height, kMaxSize)),
                  .pixels = {}};
  mask.pixels.assign(pixels, pixels + height * width);
  return mask;
}

PersonMask OneMask(const Masks& mask) {
  if (mask.ndim() != 2) throw BadInput("mask: has the shape " + ShapeTextOf(mask) + ", allowed: (any, any)");
  return MaskOf(mask.data(), mask.shape(0), mask.shape(1));
}

py::tuple OutlineOf(const Masks& mask, int spacing, double thinnest) {
  const PersonMask told = OneMask(mask);
  std::vector<OutlinePoint> points;
  {
    const py::gil_scoped_release free;
    points = Outline(told, {.spacing = spacing, .thinnest = thinnest});
  }
  const auto count = static_cast<py::ssize_t>(points.size());
  Array pixels({count, py::ssize_t{2}}), normals({count, py::ssize_t{2}});
  double *pixel = pixels.mutable_data(), *normal = normals.mutable_data();
  for (const OutlinePoint& point : points) {
    for (int axis = 0; axis < 2; ++axis) *pixel++ = point.pixel[axis], *normal++ = point.normal[axis];
  }
  return py::make_tuple(pixels, normals);
}

py::array_t<float> DistancesOf(const Masks& mask) {
  const PersonMask told = OneMask(mask);
  std::vector<float> distances;
  {
    const py::gil_scoped_release free;
    distances = SignedDistances(told);
  }
  py::array_t<float> array({mask.shape(0), mask.shape(1)});
  std::ranges::copy(distances, array.mutable_data());
  return array;
}

Array TrackAll(const std::vector<Camera>& cameras, const std::vector<Masks>& masks, double stature_m,
               const std::optional<Motion>& measured, double rate_hz) {
  std::vector<std::vector<PersonMask>> told;
  for (const Masks& film : masks) {
    if (film.ndim() != 3)
      throw BadInput("masks: one has the shape " + ShapeTextOf(film) + ", allowed: (any, any, any)");
    std::vector<PersonMask>& frames = told.emplace_back();
    for (py::ssize_t i = 0; i < film.shape(0); ++i) {
      frames.push_back(MaskOf(film.data() + i * film.shape(1) * film.shape(2), film.shape(1), film.shape(2)));
    }
  }
  SilhouetteOptions options{.stature_m = stature_m, .measured = {}, .rate_hz = rate_hz};
  if (measured) {
    if (measured->poses.empty()) throw BadInput("measured: has no frames");
    options.measured = measured->poses;
  }
  std::vector<std::optional<Pose>> poses;
  {
    const py::gil_scoped_release free;
    poses = TrackSilhouettes(cameras, told, options);
  }
  Array places({static_cast<py::ssize_t>(poses.size()), py::ssize_t{20}, py::ssize_t{3}});
  double* place = places.mutable_data();
  for (const std::optional<Pose>& pose : poses) {
    for (std::size_t i = 0; i < kRoleCount; ++i, place += 3) Put(pose ? pose->joints[i] : glm::dvec3(kNan), place);
  }
  return places;
}

}  // namespace

void AddVision(py::module_& module) {
  py::class_<Finder>(module, "PersonFinder", "Cuts the person out of one camera's pictures, one after the other.")
      .def(py::init(&MakeFinder), "background"_a, "segmenter"_a = PersonFinderOptions{}.segmenter,
           "all_pieces"_a = false,
           "background: the empty room, height x width x 3 of uint8, red, green, blue. segmenter: 'hue-gated', 'rgb', "
           "'hue', 'ratio', 'running', 'likelihood'. all_pieces: of what changed, every piece of some size near the "
           "largest.")
      .def("find", &FindIn, "picture"_a, "The mask (height x width, bool) of the next picture.");
  module.def(
      "outline", &OutlineOf, "mask"_a, "spacing"_a = OutlineOptions{}.spacing, "thinnest"_a = OutlineOptions{}.thinnest,
      "(n x 2 pixels, n x 2 unit normals out of the person) along the rim of a mask (height x width, bool), from "
      "its top; the first pixel's centre is (0.5, 0.5). spacing: one point in every square of so many pixels, 1 "
      "to 1000. thinnest: what is thinner than twice so many pixels is no part of the person, 0 to 100. Raises "
      "BadInput for another shape, sides that are not from 1 to 8192, and numbers out of range.");
  module.def("signed_distances", &DistancesOf, "mask"_a,
             "How far each pixel's centre is from the rim of a mask (height x width, bool): height x width of float32, "
             "pixels, positive outside. Raises BadInput as `outline`.");
  module.def(
      "track_silhouettes", &TrackAll, "cameras"_a, "masks"_a, "stature_m"_a = SilhouetteOptions{}.stature_m,
      "measured"_a = py::none(), "rate_hz"_a = SilhouetteOptions{}.rate_hz,
      "Where the joints of a person are (frames x 20 x 3, metres, in the order of ROLES), by nothing but the "
      "outlines; NaN in frames in which fewer than two cameras show anybody. cameras: two or more that stand "
      "still, pinholes. masks: of each camera, frames x height x width of bool, of the camera's size or smaller "
      "by one whole factor. stature_m: of an average adult, 0.5 to 2.5; or measured: a Motion of this person, of "
      "which limb lengths are taken. Raises BadInput for what does not go together, and for lenses that bend.");
}

}  // namespace etude::engine
