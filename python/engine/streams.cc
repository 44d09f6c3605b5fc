#include <etude/recognition.h>
#include <etude/vision.h>

#include <cstdint>
#include <optional>

#include "python/engine/arrays.h"

namespace etude::engine {
namespace {

using Bytes = py::array_t<std::uint8_t, py::array::c_style>;

std::span<const std::uint8_t> PictureOf(const char* name, const Bytes& picture, py::ssize_t height, py::ssize_t width) {
  const bool fits = picture.ndim() == 3 && picture.shape(2) == 3 && (height == kAny || picture.shape(0) == height) &&
                    (width == kAny || picture.shape(1) == width);
  if (!fits) {
    throw BadInput(std::string(name) + ": has the shape " +
                   ShapeText({picture.shape(), picture.shape() + picture.ndim()}) +
                   ", allowed: " + ShapeText({height, width, 3}));
  }
  return {picture.data(), static_cast<std::size_t>(picture.size())};
}

/// A PersonFinder and the size that its masks have.
struct Finder {
  PersonFinder finder;
  py::ssize_t height, width;
};

Finder MakeFinder(const Bytes& background, const std::string& segmenter, bool all_pieces) {
  const auto bytes = PictureOf("background", background, kAny, kAny);
  constexpr py::ssize_t kLargest = 1 << 20;  // which the engine refuses
  const int height = static_cast<int>(std::min(background.shape(0), kLargest));
  const int width = static_cast<int>(std::min(background.shape(1), kLargest));
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

Recogniser Teach(const std::vector<std::pair<std::string, std::vector<Motion>>>& moves, const std::string& kind,
                 bool smooths) {
  std::vector<TaughtMove> taught;
  for (const auto& [name, examples] : moves) taught.push_back({name, examples});
  const py::gil_scoped_release free;
  return Recogniser(taught, {.kind = kind, .smooths = smooths});
}

py::tuple UpdateStream(RecogniserStream& stream, const Array& positions_m, const std::string& states, bool body_seen) {
  Expect("positions_m", positions_m, {kRoleCount, 3});
  if (!states.empty() && states.size() != kRoleCount) {
    throw BadInput("states: " + std::to_string(states.size()) + " letters; allowed: 20, or none");
  }
  SensedPose frame{.pose = {}, .seen = {}, .body_seen = body_seen};
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    frame.pose.joints[i] = Vector(positions_m.data() + 3 * i);
    if (states.empty()) continue;
    const std::size_t place = std::string_view("tin").find(states[i]);
    if (place == std::string_view::npos) throw BadInput("states: letters are t, i, n");
    frame.seen[i] = static_cast<Seen>(place);
  }
  Evidence evidence;
  {
    const py::gil_scoped_release free;
    evidence = stream.Update(frame);
  }
  return py::make_tuple(evidence.asked, ToArray(evidence.spotted, {static_cast<py::ssize_t>(evidence.spotted.size())}));
}

}  // namespace

void AddStreams(py::module_& module) {
  py::class_<Finder>(module, "PersonFinder", "Cuts the person out of one camera's pictures, one after the other.")
      .def(py::init(&MakeFinder), "background"_a, "segmenter"_a = PersonFinderOptions{}.segmenter,
           "all_pieces"_a = false,
           "background: the empty room, height x width x 3 of uint8, red, green, blue. segmenter: 'hue-gated', 'rgb', "
           "'hue', 'ratio', 'running'. all_pieces: of what changed, every piece of some size near the largest.")
      .def("find", &FindIn, "picture"_a, "The mask (height x width, bool) of the next picture.");
  py::class_<Recogniser>(module, "Recogniser", "A recogniser that was taught moves.")
      .def(py::init(&Teach), "moves"_a, "kind"_a = RecogniserOptions{}.kind, "smooths"_a = true,
           "moves: (name, [Motion, ...]) of each, its right performances. kind: 'whole-body', 'dtw', 'nearest'. "
           "smooths: "
           "streams go through Kinect's own filter first.")
      .def("follow", &Recogniser::Follow, "rate_hz"_a = 30.0, "A stream to be followed, frame by frame.");
  py::class_<RecogniserStream>(module, "RecogniserStream", "One stream that a recogniser follows.")
      .def("ask", &RecogniserStream::Ask, "move"_a,
           "Asks for a move, by its number, from the next frame on; None: for none.")
      .def("update", &UpdateStream, "positions_m"_a, "states"_a = "", "body_seen"_a = true,
           "Takes the next frame (20 x 3 metres, in the order of ROLES; states: a letter a joint, t tracked, i "
           "inferred, n "
           "not tracked; '': all tracked) and gives (asked, spotted): how right the move asked for is so far, and of "
           "every move how much this looks like the end of it, all 0 to 1.");
}

}  // namespace etude::engine
