#include <etude/fuzzy.h>
#include <etude/motion.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>

#include "python/engine/arrays.h"

namespace etude::engine {
namespace {

Motion MakeMotion(const Array& positions_m, double rate_hz) {
  Expect("positions_m", positions_m, {kAny, kRoleCount, 3});
  ExpectFinite("positions_m", positions_m);
  if (!(std::isfinite(rate_hz) && rate_hz > 0)) throw BadInput("rate_hz: must be above 0");
  Motion motion{.rate_hz = rate_hz, .poses = std::vector<Pose>(static_cast<std::size_t>(positions_m.shape(0)))};
  const double* place = positions_m.data();
  for (Pose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) {
      joint = Vector(place);
      place += 3;
    }
  }
  return motion;
}

Array PositionsOf(const Motion& motion) {
  Array positions(
      {static_cast<py::ssize_t>(motion.poses.size()), static_cast<py::ssize_t>(kRoleCount), py::ssize_t{3}});
  double* place = positions.mutable_data();
  for (const Pose& pose : motion.poses) {
    for (const glm::dvec3& joint : pose.joints) {
      Put(joint, place);
      place += 3;
    }
  }
  return positions;
}

Motion ReadFile(const std::filesystem::path& path, double rate_hz) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  if (!file) throw BadInput(path.string() + ": cannot be read");
  return ReadMotion(bytes, path.string(), rate_hz);
}

std::vector<std::string> RoleNames() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kRoleCount; ++i) names.emplace_back(RoleName(static_cast<Role>(i)));
  return names;
}

Features ToFeatures(const char* name, const Array& array) {
  Expect(name, array, {kFeatureCount});
  ExpectFinite(name, array);
  Features features;
  std::copy_n(array.data(), kFeatureCount, features.begin());
  return features;
}

}  // namespace

void AddMotions(py::module_& module) {
  py::class_<Motion>(module, "Motion", "Frames at a fixed rate: where the twenty joints of `ROLES` are.")
      .def(py::init(&MakeMotion), "positions_m"_a, "rate_hz"_a = 30.0,
           "positions_m: frames x 20 x 3, metres, Y up. Raises BadInput for another shape or what is not finite.")
      .def_readonly("rate_hz", &Motion::rate_hz)
      .def_property_readonly("positions_m", &PositionsOf, "A copy: frames x 20 x 3, metres, Y up.")
      .def("__len__", [](const Motion& motion) { return motion.poses.size(); });
  module.attr("ROLES") = py::tuple(py::cast(RoleNames()));
  module.def(
      "read_motion", &ReadFile, "path"_a, "rate_hz"_a = 30.0, py::call_guard<py::gil_scoped_release>(),
      "Reads a BVH, AMASS, C3D or TRC file as the twenty joints. Raises BadInput with the place and what was found.");

  module.attr("FEATURES") = py::tuple(py::cast(FeatureNames()));
  module.def(
      "features",
      [](const Motion& motion) {
        const std::vector<Features> found = ComputeFeatures(motion);
        Array array({static_cast<py::ssize_t>(found.size()), static_cast<py::ssize_t>(kFeatureCount)});
        double* value = array.mutable_data();
        for (const Features& features : found) value = std::copy(features.begin(), features.end(), value);
        return array;
      },
      "motion"_a, "The ten pose features of every frame: frames x 10, degrees but for Posture (standing = 80).");
  module.def(
      "fuzzy_distance",
      [](const Array& a, const Array& b) { return FuzzyDistance(ToFeatures("a", a), ToFeatures("b", b)); }, "a"_a,
      "b"_a, "The fuzzy distance of two frames' features, from 0.");
  py::class_<Bridges>(module, "Bridges",
                      "Clips made ready for transitions: performed by the body of the first, and tagged.")
      .def(py::init([](const std::vector<Motion>& clips, int min_clips, double threshold) {
             return std::make_unique<Bridges>(clips, BridgeOptions{min_clips, threshold});
           }),
           "clips"_a, "min_clips"_a = BridgeOptions{}.min_clips, "threshold"_a = BridgeOptions{}.threshold,
           "Raises BadInput for no clips, a clip without frames, or rates that differ.")
      .def(
          "frames",
          [](const Bridges& bridges, int clip) {
            const std::span<const int> frames = bridges.FramesOf(clip);
            return py::array_t<int>(static_cast<py::ssize_t>(frames.size()), frames.data());
          },
          "clip"_a, "The bridge frames of a clip, rising.")
      .def(
          "find",
          [](const Bridges& bridges, int clip, int frame, int to, double budget_s) -> py::object {
            const auto point = bridges.Find(clip, frame, to, budget_s);
            return point ? py::object(py::make_tuple(point->from, point->to, point->distance)) : py::none();
          },
          "clip"_a, "frame"_a, "to"_a, "budget_s"_a = 1.0,
          "(frame to leave at, frame to enter at, fuzzy distance) of the first match while `clip` goes on from "
          "`frame`, else "
          "None.");
}

}  // namespace etude::engine
