#include <etude/fuzzy.h>
#include <etude/motion.h>
#include <etude/sim/dances.h>
#include <etude/transitions.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "engine/streams/recording.h"
#include "python/engine/arrays.h"

namespace etude::engine {
namespace {

using Settings = std::map<std::string, double>;

/// A motion read from a file, with notes on what was found and changed.
struct FileMotion : BodyMotion {
  std::vector<std::string> changes;
};

/// Throws BadInput if the trunk (median over the frames) would be human in centimetres or millimetres.
void ExpectMetres(const std::vector<BodyPose>& poses) {
  if (poses.empty()) return;
  std::vector<double> trunks;
  for (const BodyPose& pose : poses)
    trunks.push_back(glm::distance(pose[Role::kHipCentre], pose[Role::kShoulderCentre]));
  const auto middle = trunks.begin() + static_cast<std::ptrdiff_t>(trunks.size() / 2);
  std::ranges::nth_element(trunks, middle);
  for (const auto& [metres, unit] : {std::pair{0.01, "centimetres"}, {0.001, "millimetres"}}) {
    if (*middle * metres < kMinTrunk_m || *middle * metres > kMaxTrunk_m) continue;
    throw BadInput(fmt::format(
        "positions_m: the distance from hip centre to shoulder centre is {:.3g}; allowed: {} to {} m; the positions "
        "seem to be in {}",
        *middle, kMinTrunk_m, kMaxTrunk_m, unit));
  }
}

BodyMotion MakeMotion(const Array& positions_m, double rate_hz) {
  BodyMotion motion{.rate_hz = rate_hz, .poses = FromArrays<BodyPose>("positions_m", positions_m)};
  ExpectFinite("positions_m", positions_m);
  ExpectMetres(motion.poses);
  if (!(std::isfinite(rate_hz) && rate_hz > 0)) throw BadInput("rate_hz: must be above 0");
  return motion;
}

FileMotion ReadFile(const std::filesystem::path& path, double rate_hz, bool keep_floor, const std::string& up,
                    double metres_per_unit, const std::string& marker_set) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  if (!file) throw BadInput(path.string() + ": cannot be read");
  if (up.size() > 1) throw BadInput("up: '" + up + "'; allowed: y, z");
  const ReadingOptions options{.keep_floor = keep_floor,
                               .up = up.empty() ? '\0' : up.front(),
                               .metres_per_unit = metres_per_unit,
                               .marker_set = marker_set};
  FileMotion motion;
  static_cast<BodyMotion&>(motion) = ReadMotion(bytes, path.string(), rate_hz, options, &motion.changes);
  return motion;
}

/// Returns the names of roles or features.
std::vector<std::string> NamesOf(const auto& all,
                                 std::string_view (*name_of)(typename std::decay_t<decltype(all)>::value_type)) {
  std::vector<std::string> names;
  for (const auto one : all) names.emplace_back(name_of(one));
  return names;
}

}  // namespace

void AddMotions(py::module_& module) {
  py::class_<BodyMotion>(module, "Motion", "Frames at a fixed rate: where the twenty joints of `ROLES` are.")
      .def(py::init(&MakeMotion), "positions_m"_a, "rate_hz"_a = 30.0,
           "positions_m: frames x 20 x 3, metres, Y up. Raises BadInput for another shape, numbers that are not "
           "finite (as masked ones count), and a body that is human in cm or mm.")
      .def_readonly("rate_hz", &BodyMotion::rate_hz)
      .def_property_readonly("positions_m", ArraysOf(&BodyMotion::poses), "A copy: frames x 20 x 3, metres, Y up.")
      .def("__len__", [](const BodyMotion& motion) { return motion.poses.size(); });
  py::class_<FileMotion, BodyMotion>(module, "FileMotion", "A Motion that was read.")
      .def_readonly("changes", &FileMotion::changes, "What was found, and every change of what the file holds.");
  module.attr("ROLES") = py::tuple(py::cast(NamesOf(AllRoles(), RoleName)));
  module.def(
      "read_motion", &ReadFile, "path"_a, "rate_hz"_a = 30.0, "keep_floor"_a = false, "up"_a = "",
      "metres_per_unit"_a = 0.0, "marker_set"_a = "", py::call_guard<py::gil_scoped_release>(),
      "Reads a BVH, AMASS, C3D, TRC, CSV or Etude's own .npz file as the twenty joints, on the floor unless "
      "keep_floor; "
      "up ('y' or 'z'), metres_per_unit and marker_set overrule what is found. `changes` of the motion says what was "
      "changed. Raises BadInput with the place and what was found.");

  module.attr("FEATURES") = py::tuple(py::cast(NamesOf(AllFeatures(), FeatureName)));
  module.def(
      "features", [](const BodyMotion& motion) { return ToArrays(Unlocked([&] { return ComputeFeatures(motion); })); },
      "motion"_a, "The ten pose features of every frame: frames x 10, in degrees except Posture (standing = 80).");
  module.def(
      "fuzzy_distance",
      [](const Array& a, const Array& b) {
        return FuzzyDistance(FromArray<PoseFeatures>("a", a), FromArray<PoseFeatures>("b", b));
      },
      "a"_a, "b"_a, "The fuzzy distance of two frames' features, from 0.");
  py::class_<Bridges>(module, "Bridges",
                      "Clips made ready for transitions: performed by the body of the first, and tagged.")
      .def(py::init([](const std::vector<BodyMotion>& clips, int min_clips, double threshold) {
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
            const auto point = Unlocked([&] { return bridges.Find(clip, frame, to, budget_s); });
            return point ? py::object(py::make_tuple(point->from, point->to, point->distance)) : py::none();
          },
          "clip"_a, "frame"_a, "to"_a, "budget_s"_a = 1.0,
          "(frame to leave at, frame to enter at, fuzzy distance) of the first match while `clip` goes on from "
          "`frame`, else None.");

  module.attr("TRANSITION_CHOICES") = py::tuple(py::cast(TransitionChoices()));
  module.attr("TRANSITION_JOINS") = py::tuple(py::cast(TransitionJoins()));
  const auto by_key = [](const std::vector<NumberSetting>& settings) {
    py::dict told;
    for (const NumberSetting& one : settings) {
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
        return py::make_tuple(ToArray(body.pose), body.hip_height);
      },
      "Proportions of the body that performs a scenario's clips, for a TransitionLibrary: (a pose, 20 x 3 metres; the "
      "height of its hips, metres).");
  py::class_<TransitionLibrary>(
      module, "TransitionLibrary",
      "Clips made ready for transitions: performed by one body, tagged, joined by in-betweens.")
      .def(py::init(
               [](const std::vector<BodyMotion>& clips, const std::optional<std::pair<Array, double>>& proportions) {
                 std::optional<BodyProportions> body;
                 if (proportions) body = {FromArray<BodyPose>("proportions", proportions->first), proportions->second};
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
