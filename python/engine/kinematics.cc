#include <etude/kinematics.h>
#include <fmt/format.h>

#include <optional>
#include <set>

#include "python/engine/arrays.h"

namespace etude::engine {
namespace {

constexpr int kPositionNumbers = 3, kMatrixNumbers = 9;
constexpr double kZeros[3] = {}, kOnes[3] = {1, 1, 1}, kIdentity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/// A tree, and the options of the problems that are solved for this tree.
struct Body {
  KinematicTree tree;
  IkOptions options;
};

Body MakeBody(std::optional<KinematicTree> tree, int max_iterations, double position_goal_m, double axis_goal,
              std::optional<double> most_change) {
  Body body{tree ? *std::move(tree) : MakeBodyTree(LimbLengths{}), {}};
  body.options.max_iterations = max_iterations;
  body.options.position_goal = position_goal_m;
  body.options.axis_goal = axis_goal;
  body.options.angle_change_tolerance = most_change;
  if (const auto fault = FindFault(body.tree, body.options); !fault.empty()) throw BadInput(std::string(fault));
  return body;
}

/// Returns a copy of a text that is never freed, because the names of trees are views.
std::string_view Kept(std::string text) {
  static std::set<std::string>& texts = *new std::set<std::string>;
  return *texts.insert(std::move(text)).first;
}

/// The numbers of many problems in one array; the numbers of consecutive problems are `stride` apart.
struct Numbers {
  const double* first;
  py::ssize_t stride = 0;

  void Fill(std::span<double> row, py::ssize_t number) const {
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = first[number + static_cast<py::ssize_t>(i) * stride];
  }
  /// Fills the three rows of a batch that hold a position. FillMatrix fills the nine rows of a matrix, which the batch
  /// stores column by column.
  void FillPosition(const auto& row_of, py::ssize_t from = 0) const {
    for (int axis = 0; axis < kPositionNumbers; ++axis) Fill(row_of(axis), from + axis);
  }
  void FillMatrix(const auto& row_of, py::ssize_t from = 0) const {
    for (int n = 0; n < kMatrixNumbers; ++n) Fill(row_of(kPositionNumbers + n), from + n % 3 * 3 + n / 3);
  }
};

/// Returns the positions or axes of the roots of `count` poses. `given` holds one position (or one set of axes) for all
/// poses, or one for each pose; without `given`, the roots have the world's origin and axes.
Numbers RootsOf(const char* name, const std::optional<Array>& given, std::vector<py::ssize_t> shape, py::ssize_t count,
                const double* world) {
  if (!given) return {world};
  const bool is_one = static_cast<std::size_t>(given->ndim()) == shape.size();
  if (!is_one) shape.insert(shape.begin(), count);
  Expect(name, *given, shape);
  ExpectFinite(name, *given);
  return {given->data(), is_one ? 0 : given->size() / std::max<py::ssize_t>(count, 1)};
}

/// Returns the positions (poses, n, 3) and axes (poses, n, 3, 3) of the limbs or effectors of many poses.
py::tuple FramesOfPoses(const Body& body, std::vector<LimbFrame> TreeFrames::*of, std::size_t per_pose,
                        const Array& angles, const std::optional<Array>& positions_m,
                        const std::optional<Array>& axes) {
  const int dofs = body.tree.dof_count();
  Expect("angles", angles, {kAny, dofs});
  const py::ssize_t count = angles.shape(0), n = static_cast<py::ssize_t>(per_pose);
  const Numbers places = RootsOf("root_positions_m", positions_m, {3}, count, kZeros);
  const Numbers turns = RootsOf("root_axes", axes, {3, 3}, count, kIdentity);
  Array found({count, n, py::ssize_t{3}}), turned({count, n, py::ssize_t{3}, py::ssize_t{3}});
  double* place = found.mutable_data();
  double* turn = turned.mutable_data();
  const double* angle = angles.data();
  {
    const py::gil_scoped_release free;
    TreeFrames frames;
    for (py::ssize_t i = 0; i < count; ++i, angle += dofs) {
      const TreeState state{Get<glm::dvec3>(places.first + i * places.stride),
                            Get<glm::dmat3>(turns.first + i * turns.stride),
                            {angle, angle + dofs}};
      ComputeFrames(body.tree, state, frames);
      for (const LimbFrame& frame : frames.*of) {
        Put(frame.position, place);
        Put(frame.axes, turn);
        place += kPositionNumbers;
        turn += kMatrixNumbers;
      }
    }
  }
  return py::make_tuple(found, turned);
}

struct Solved {
  Array angles;
  py::array_t<int> statuses, iterations;
};

Solved Solve(const Body& body, const Array& starts, const Array& targets_m, const std::optional<Array>& target_axes,
             const std::optional<Array>& position_weights, const std::optional<Array>& axis_weights,
             const std::optional<Array>& root_positions_m, const std::optional<Array>& root_axes, bool in_floats) {
  const int dofs = body.tree.dof_count();
  const py::ssize_t effectors = static_cast<py::ssize_t>(body.tree.effectors.size());
  Expect("start_angles", starts, {kAny, dofs});
  const py::ssize_t count = starts.shape(0);
  Expect("target_positions_m", targets_m, {count, effectors, 3});
  if (target_axes) Expect("target_axes", *target_axes, {count, effectors, 3, 3});
  if (position_weights) Expect("position_weights", *position_weights, {effectors});
  if (axis_weights) Expect("axis_weights", *axis_weights, {effectors, 3});
  constexpr py::ssize_t kMost = 10'000'000;
  if (count > kMost) throw BadInput(fmt::format("{} problems; allowed: {}", count, kMost));
  const Numbers root_places = RootsOf("root_positions_m", root_positions_m, {3}, count, kZeros);
  const Numbers root_turns = RootsOf("root_axes", root_axes, {3, 3}, count, kIdentity);
  const Numbers angles{starts.data(), dofs}, places{targets_m.data(), 3 * effectors};
  const double* axes = target_axes ? target_axes->data() : nullptr;
  const double* weights = position_weights ? position_weights->data() : nullptr;
  const double* of_axes = axis_weights ? axis_weights->data() : nullptr;
  IkBatchSolution solution;
  {
    const py::gil_scoped_release free;
    IkBatch batch(body.tree, static_cast<int>(count));
    for (int dof = 0; dof < dofs; ++dof) {
      Numbers{&body.tree.limits[dof].lower}.Fill(batch.lower_limits(dof), 0);
      Numbers{&body.tree.limits[dof].upper}.Fill(batch.upper_limits(dof), 0);
      angles.Fill(batch.start_angles(dof), dof);
    }
    const auto root = [&](int number) { return batch.root(number); };
    root_places.FillPosition(root);
    root_turns.FillMatrix(root);
    for (int e = 0; e < effectors; ++e) {
      const auto target = [&](int number) { return batch.target(e, number); };
      const auto weight = [&](int axis) { return batch.target(e, IkBatch::kTargetNumbers - 3 + axis); };
      places.FillPosition(target, 3 * e);
      (axes != nullptr ? Numbers{axes, 9 * effectors} : Numbers{kIdentity})
          .FillMatrix(target, axes != nullptr ? 9 * e : 0);
      Numbers{weights != nullptr ? weights + e : kOnes}.Fill(batch.target(e, IkBatch::kTargetNumbers - 4), 0);
      Numbers{of_axes != nullptr ? of_axes + 3 * e : axes != nullptr ? kOnes : kZeros}.FillPosition(weight);
    }
    solution =
        SolveGaussNewtonBatch(body.tree, batch, body.options, in_floats ? Precision::kFloat : Precision::kDouble);
  }
  Solved solved{Array({count, py::ssize_t{dofs}}), py::array_t<int>(count), py::array_t<int>(count)};
  double* angle = solved.angles.mutable_data();
  for (py::ssize_t i = 0; i < count; ++i) {
    for (int dof = 0; dof < dofs; ++dof) *angle++ = solution.angles_of(dof)[i];
    solved.statuses.mutable_data()[i] = static_cast<int>(solution.statuses[i]);
    solved.iterations.mutable_data()[i] = solution.iterations[i];
  }
  return solved;
}

KinematicTree MakeTree(std::vector<TreeJoint> limbs, std::vector<Effector> effectors, const Array& limits) {
  KinematicTree tree{std::move(limbs), std::move(effectors), {}};
  int dofs = 0;
  for (TreeJoint& joint : tree.joints) {
    joint.first_dof = dofs;
    dofs += joint.dof_count;
  }
  for (const glm::dvec2& range : FromArrays<glm::dvec2>("limits", limits)) tree.limits.push_back({range.x, range.y});
  return tree;
}

Array LimitsOf(const KinematicTree& tree) {
  std::vector<glm::dvec2> limits;
  for (const AngleRange& range : tree.limits) limits.emplace_back(range.lower, range.upper);
  return ToArrays(limits);
}

}  // namespace

void AddKinematics(py::module_& module) {
  py::class_<TreeJoint>(module, "Limb", "A joint and the rigid limb beyond it; see docs/library.md.")
      .def(
          py::init([](std::string name, int parent, const Array& offset_m, int dofs, const std::optional<Array>& rest) {
            return TreeJoint{.name = Kept(std::move(name)),
                             .parent = parent,
                             .p_PJ = FromArray<glm::dvec3>("offset_m", offset_m),
                             .R_PJ = rest ? FromArray<glm::dmat3>("rest", *rest) : glm::dmat3(1),
                             .dof_count = dofs};
          }),
          "name"_a, "parent"_a, "offset_m"_a, "dofs"_a, "rest"_a = py::none(),
          "parent: a limb before this one, -1 for the root; offset_m, rest: of the joint in the parent's axes; dofs: "
          "0 to 3 turns about x, y, z.")
      .def_readonly("name", &TreeJoint::name)
      .def_readonly("parent", &TreeJoint::parent)
      .def_readonly("dofs", &TreeJoint::dof_count)
      .def_property_readonly("offset_m", ArrayOf(&TreeJoint::p_PJ))
      .def_property_readonly("rest", ArrayOf(&TreeJoint::R_PJ));
  py::class_<Effector>(module, "Effector", "The free end of a limb, for which a target is set.")
      .def(py::init([](std::string name, int limb, const Array& offset_m) {
             return Effector{Kept(std::move(name)), limb, FromArray<glm::dvec3>("offset_m", offset_m)};
           }),
           "name"_a, "limb"_a, "offset_m"_a)
      .def_readonly("name", &Effector::name)
      .def_readonly("limb", &Effector::joint)
      .def_property_readonly("offset_m", ArrayOf(&Effector::p_LE));
  py::class_<KinematicTree>(module, "Tree", "Any tree of joints.")
      .def(py::init(&MakeTree), "limbs"_a, "effectors"_a, "limits"_a,
           "limits: (lower, upper) of each degree of freedom, radians, limb after limb.")
      .def_readonly("limbs", &KinematicTree::joints)
      .def_readonly("effectors", &KinematicTree::effectors)
      .def_property_readonly("limits", &LimitsOf);
  module.def(
      "adult_body", [] { return MakeBodyTree(LimbLengths{}); },
      "A person of usual build: 15 limbs, 29 degrees of freedom, 4 effectors.");

  py::class_<Solved>(module, "Solved", "Answers to many problems of inverse kinematics.")
      .def_readonly("angles", &Solved::angles, "problems x degrees of freedom, radians")
      .def_readonly("statuses", &Solved::statuses, "an index of `STATUSES` per problem")
      .def_readonly("iterations", &Solved::iterations);
  module.attr("STATUSES") = py::make_tuple("converged", "stalled", "unreachable", "iteration_limit", "bad_input");

  py::class_<Body>(module, "Kinematics", "Forward and inverse kinematics of one tree.")
      .def(py::init(&MakeBody), "tree"_a = py::none(), "max_iterations"_a = IkOptions{}.max_iterations,
           "position_goal_m"_a = IkOptions{}.position_goal, "axis_goal"_a = IkOptions{}.axis_goal,
           "most_change"_a = py::none(),
           "tree: adult_body() by default. A pose has converged within position_goal_m and axis_goal (radians). "
           "most_change: largest change of an angle from its start, radians. Raises BadInput if it is not a tree.")
      .def_readonly("tree", &Body::tree)
      .def_property_readonly("dofs", [](const Body& body) { return body.tree.dof_count(); })
      .def(
          "limbs",
          [](const Body& body, const Array& angles, const std::optional<Array>& places,
             const std::optional<Array>& axes) {
            return FramesOfPoses(body, &TreeFrames::joints, body.tree.joints.size(), angles, places, axes);
          },
          "angles"_a, "root_positions_m"_a = py::none(), "root_axes"_a = py::none(),
          "Positions and axes of all limbs of many poses: (poses x limbs x 3 metres, poses x limbs x 3 x 3 axes as "
          "columns). angles: poses x degrees of freedom, radians. The root: one for all, or one a pose; the world's "
          "frame by default.")
      .def(
          "effectors",
          [](const Body& body, const Array& angles, const std::optional<Array>& places,
             const std::optional<Array>& axes) {
            return FramesOfPoses(body, &TreeFrames::effectors, body.tree.effectors.size(), angles, places, axes);
          },
          "angles"_a, "root_positions_m"_a = py::none(), "root_axes"_a = py::none(),
          "The same as `limbs`, for the effectors.")
      .def("solve", &Solve, "start_angles"_a, "target_positions_m"_a, "target_axes"_a = py::none(),
           "position_weights"_a = py::none(), "axis_weights"_a = py::none(), "root_positions_m"_a = py::none(),
           "root_axes"_a = py::none(), py::kw_only(), "single_precision"_a = false,
           "Solves many problems. start_angles: problems x degrees of freedom, radians; target_positions_m: problems x "
           "effectors x 3; target_axes: problems x effectors x 3 x 3, columns, None where positions alone count; "
           "weights: effectors, and effectors x 3. Numbers that are not finite make that problem 'bad_input'. Raises "
           "BadInput for other shapes.");
}

}  // namespace etude::engine
