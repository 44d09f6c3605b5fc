#include <etude/fuzzy.h>
#include <etude/motion.h>
#include <etude/sim/dances.h>
#include <etude/transitions.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "python/engine/arrays.h"

namespace etude::engine {
namespace {

using Settings = std::map<std::string, double>;

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

Motion ReadFile(const std::filesystem::path& path, double rate_hz, bool keep_floor, const std::string& up,
                double metres_per_unit, const std::string& marker_set) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  if (!file) throw BadInput(path.string() + ": cannot be read");
  if (up.size() > 1) throw BadInput("up: '" + up + "'; allowed: y, z");
  return ReadMotion(bytes, path.string(), rate_hz,
                    {.keep_floor = keep_floor,
                     .up = up.empty() ? '\0' : up.front(),
                     .metres_per_unit = metres_per_unit,
                     .marker_set = marker_set});
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
      .def_readonly("changes", &Motion::changes,
                    "Of a motion that was read: what was found, and every change of what the file holds.")
      .def("__len__", [](const Motion& motion) { return motion.poses.size(); });
  module.attr("ROLES") = py::tuple(py::cast(RoleNames()));
  module.def(
      "read_motion", &ReadFile, "path"_a, "rate_hz"_a = 30.0, "keep_floor"_a = false, "up"_a = "",
      "metres_per_unit"_a = 0.0, "marker_set"_a = "", py::call_guard<py::gil_scoped_release>(),
      "Reads a BVH, AMASS, C3D, TRC, CSV or Etude's own .npz file as the twenty joints, on the floor unless keep_floor; "
      "up ('y' or 'z'), metres_per_unit and marker_set overrule what is found. `changes` of the motion says what was "
      "changed. Raises BadInput with the place and what was found.");

  module.attr("FEATURES") = py::tuple(py::cast(FeatureNames()));
  module.def(
      "features",
      [](const Motion& motion) {
        std::vector<Features> found;
        {
          const py::gil_scoped_release free;
          found = ComputeFeatures(motion);
        }
        Array array({static_cast<py::ssize_t>(found.size()), static_cast<py::ssize_t>(kFeatureCount)});
        double* value = array.mutable_data();
        for (const Features& features : found) value = std::copy(features.begin(), features.end(), value);
        return array;
      },
      "motion"_a, "The ten pose features of every frame: frames x 10, in degrees except Posture (standing = 80).");
  module.def(
      "fuzzy_distance",
      [](const Array& a, const Array& b) { return FuzzyDistance(ToFeatures("a", a), ToFeatures("b", b)); }, "a"_a,
      "b"_a, "The fuzzy distance of two frames' features, from 0.");
  py::class_<Bridges>(module, "Bridges",
                      "Clips made ready for transitions: performed by the body of the first, and tagged.")
      .def(py::init([](const std::vector<Motion>& clips, int min_clips, double threshold) {
             const py::gil_scoped_release free;
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
          "clip"_a, "The bridge frames of a clip, in ascending order.")
      .def(
          "find",
          [](const Bridges& bridges, int clip, int frame, int to, double budget_s) -> py::object {
            const auto point = [&] {
              const py::gil_scoped_release free;
              return bridges.Find(clip, frame, to, budget_s);
            }();
            return point ? py::object(py::make_tuple(point->from, point->to, point->distance)) : py::none();
          },
          "clip"_a, "frame"_a, "to"_a, "budget_s"_a = 1.0,
          "(frame to leave at, frame to enter at, fuzzy distance) of the first match while `clip` goes on from "
          "`frame`, else None.");

  module.attr("TRANSITION_CHOICES") = py::tuple(py::cast(TransitionChoices()));
  module.attr("TRANSITION_JOINS") = py::tuple(py::cast(TransitionJoins()));
  const auto by_key = [](const std::vector<TransitionSetting>& settings) {
    py::dict told;
    for (const TransitionSetting& one : settings) {
      told[one.key.c_str()] = py::make_tuple(one.fallback, one.lowest, one.largest, one.meaning);
    }
    return told;
  };
  module.def(
      "transition_choice_settings",
      [by_key](const std::string& name) { return by_key(TransitionChoiceSettings(name)); }, "choice"_a,
      "The settings of a choice: {key: (default, lowest, largest, meaning)}.");
  module.def(
      "transition_join_settings", [by_key](const std::string& name) { return by_key(TransitionJoinSettings(name)); },
      "join"_a, "The settings of a join: {key: (default, lowest, largest, meaning)}.");
  py::class_<Transition>(module, "Transition", "A transition from one clip into another, as shown.")
      .def_readonly("motion", &Transition::motion,
                    "The playing clip from its first frame, what lies between, and the wanted clip to its end; no "
                    "frames if there is no way.")
      .def_readonly("points", &Transition::points,
                    "The last frames of `motion` before each change of clip, in ascending order.")
      .def_readonly("wait_s", &Transition::wait_s, "Seconds from the request until the wanted clip plays.")
      .def_readonly("branch", &Transition::branch, "The kind of way: 'front half', 'in-between', 'now', 'none', …")
      .def_readonly("why", &Transition::why, "One sentence: why this way won, or why there is none.");
  module.def(
      "scenario_proportions",
      [] {
        const BodyProportions body = sim::ScenarioProportions();
        return py::make_tuple(FromPose(body.pose), body.hip_height);
      },
      "Proportions of the body that performs a scenario's clips, for a TransitionLibrary: (a pose, 20 x 3 metres; the "
      "height of its hips, metres).");
  py::class_<TransitionLibrary>(
      module, "TransitionLibrary",
      "Clips made ready for transitions: performed by one body, tagged, joined by in-betweens.")
      .def(py::init([](const std::vector<Motion>& clips, const std::optional<std::pair<Array, double>>& proportions) {
             std::optional<BodyProportions> body;
             if (proportions) body = {ToPose("proportions", proportions->first), proportions->second};
             const py::gil_scoped_release free;
             return std::make_unique<TransitionLibrary>(clips, body);
           }),
           "clips"_a, "proportions"_a = py::none(),
           "proportions: of the body that performs the clips, (a pose, 20 x 3 metres; the standing height of its hips, "
           "metres), such as scenario_proportions(); else the first clip's. Raises BadInput for no clips, fewer than "
           "two frames, another rate than 30 Hz, a body without legs.")
      .def(
          "make",
          [](const TransitionLibrary& library, int clip, int frame, int to, double budget_s, const std::string& choice,
             const std::string& join, double threshold, const Settings& choice_settings,
             const Settings& join_settings) {
            const TransitionOptions options{.choice = choice,
                                            .join = join,
                                            .threshold = threshold,
                                            .choice_settings = choice_settings,
                                            .join_settings = join_settings};
            const py::gil_scoped_release free;
            return library.Make(clip, frame, to, budget_s, options);
          },
          "clip"_a, "frame"_a, "to"_a, "budget_s"_a = 1.0, "choice"_a = TransitionOptions{}.choice,
          "join"_a = TransitionOptions{}.join, "threshold"_a = TransitionOptions{}.threshold,
          "choice_settings"_a = Settings{}, "join_settings"_a = Settings{},
          "The Transition from a frame of a clip, which is the one shown when the clip `to` is asked for. budget_s: "
          "longest wait, 0 to 3600. choice: which frames, of TRANSITION_CHOICES; join: how they are put together, of "
          "TRANSITION_JOINS; threshold: of the fuzzy choices, in (0, 6]; choice_settings, join_settings: numbers by "
          "the keys of transition_choice_settings and transition_join_settings. Raises BadInput for unknown names, "
          "clips, frames or settings.");
}

}  // namespace etude::engine
