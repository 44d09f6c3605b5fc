#include <etude/kinematics.h>

#include <memory>
#include <optional>

#include "python/engine/arrays.h"

namespace etude::engine {
namespace {

/// Returns the roots of `count` poses: one for all, or one each; the world's frame if none is given.
std::vector<Frame> ToRoots(const std::optional<Array>& positions_m, const std::optional<Array>& axes,
                           py::ssize_t count) {
  for (const auto* given : {&positions_m, &axes}) {
    if (!*given) continue;
    const std::vector<py::ssize_t> cell =
        given == &positions_m ? std::vector<py::ssize_t>{3} : std::vector<py::ssize_t>{3, 3};
    std::vector<py::ssize_t> each = cell;
    each.insert(each.begin(), count);
    const char* name = given == &positions_m ? "root_positions_m" : "root_axes";
    if (static_cast<std::size_t>((*given)->ndim()) != cell.size())
      Expect(name, **given, each);
    else
      Expect(name, **given, cell);
    ExpectFinite(name, **given);
  }
  const bool is_one = !(positions_m && positions_m->ndim() == 2) && !(axes && axes->ndim() == 3);
  std::vector<Frame> roots(static_cast<std::size_t>(is_one ? 1 : count));
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (positions_m) roots[i].position = Vector(positions_m->data() + (positions_m->ndim() == 2 ? 3 * i : 0));
    if (axes) roots[i].axes = Matrix(axes->data() + (axes->ndim() == 3 ? 9 * i : 0));
  }
  return roots;
}

using FramesOf = std::vector<Frame> (Kinematics::*)(const TreePose&) const;

/// Returns the positions (poses, n, 3) and axes (poses, n, 3, 3) of the limbs or effectors of many poses.
py::tuple FramesOfPoses(const Kinematics& body, FramesOf frames_of, std::size_t per_pose, const Array& angles,
                        const std::optional<Array>& positions_m, const std::optional<Array>& axes) {
  Expect("angles", angles, {kAny, body.dofs()});
  const py::ssize_t count = angles.shape(0), n = static_cast<py::ssize_t>(per_pose);
  const std::vector<Frame> roots = ToRoots(positions_m, axes, count);
  Array places({count, n, py::ssize_t{3}}), turns({count, n, py::ssize_t{3}, py::ssize_t{3}});
  double* place = places.mutable_data();
  double* turn = turns.mutable_data();
  const double* angle = angles.data();
  const py::gil_scoped_release free;
  for (py::ssize_t i = 0; i < count; ++i) {
    const TreePose pose{roots[roots.size() == 1 ? 0 : static_cast<std::size_t>(i)], {angle, angle + body.dofs()}};
    for (const Frame& frame : (body.*frames_of)(pose)) {
      Put(frame.position, place);
      Put(frame.axes, turn);
      place += 3;
      turn += 9;
    }
    angle += body.dofs();
  }
  const py::gil_scoped_acquire held;
  return py::make_tuple(places, turns);
}

struct Solved {
  Array angles;
  py::array_t<int> statuses, iterations;
};

Solved Solve(const Kinematics& body, const Array& starts, const Array& targets_m,
             const std::optional<Array>& target_axes, const std::optional<Array>& position_weights,
             const std::optional<Array>& axis_weights, const std::optional<Array>& root_positions_m,
             const std::optional<Array>& root_axes, Precision precision) {
  Expect("start_angles", starts, {kAny, body.dofs()});
  const py::ssize_t count = starts.shape(0), effectors = static_cast<py::ssize_t>(body.tree().effectors.size());
  Expect("target_positions_m", targets_m, {count, effectors, 3});
  if (target_axes) Expect("target_axes", *target_axes, {count, effectors, 3, 3});
  if (position_weights) Expect("position_weights", *position_weights, {effectors});
  if (axis_weights) Expect("axis_weights", *axis_weights, {effectors, 3});
  IkBatch batch{.roots = ToRoots(root_positions_m, root_axes, count),
                .starts = {starts.data(), starts.data() + starts.size()},
                .targets = std::vector<Target>(static_cast<std::size_t>(count * effectors))};
  const double* target = targets_m.data();
  const double* axes = target_axes ? target_axes->data() : nullptr;
  const double* weights = position_weights ? position_weights->data() : nullptr;
  const double* of_axes = axis_weights ? axis_weights->data() : nullptr;
  IkBatchAnswer answer;
  {
    const py::gil_scoped_release free;
    for (std::size_t i = 0; i < batch.targets.size(); ++i) {
      const std::size_t effector = i % static_cast<std::size_t>(effectors);
      batch.targets[i].frame.position = Vector(target + 3 * i);
      if (axes != nullptr) batch.targets[i].frame.axes = Matrix(axes + 9 * i);
      if (axes == nullptr) batch.targets[i].axis_weights = glm::dvec3(0);
      if (weights != nullptr) batch.targets[i].position_weight = weights[effector];
      if (of_axes != nullptr) batch.targets[i].axis_weights = Vector(of_axes + 3 * effector);
    }
    if (count > 0) answer = body.Solve(batch, precision);
  }
  Solved solved{ToArray(answer.angles, {count, body.dofs()}), py::array_t<int>(count), py::array_t<int>(count)};
  for (std::size_t i = 0; i < answer.statuses.size(); ++i) {
    solved.statuses.mutable_data()[i] = static_cast<int>(answer.statuses[i]);
    solved.iterations.mutable_data()[i] = answer.iterations[i];
  }
  return solved;
}

}  // namespace

void AddKinematics(py::module_& module) {
  py::class_<Limb>(module, "Limb", "A joint and the rigid limb beyond it; see docs/library.md.")
      .def(
          py::init([](std::string name, int parent, const Array& offset_m, int dofs, const std::optional<Array>& rest) {
            Limb limb{.name = std::move(name), .parent = parent, .dofs = dofs};
            SetVector(&Limb::p_PJ, "offset_m")(limb, offset_m);
            if (rest) SetMatrix(&Limb::R_PJ, "rest")(limb, *rest);
            return limb;
          }),
          "name"_a, "parent"_a, "offset_m"_a, "dofs"_a, "rest"_a = py::none(),
          "parent: a limb before this one, -1 for the root; offset_m, rest: of the joint in the parent's axes; dofs: 0 "
          "to 3 "
          "turns about x, y, z.")
      .def_readonly("name", &Limb::name)
      .def_readonly("parent", &Limb::parent)
      .def_readonly("dofs", &Limb::dofs)
      .def_property_readonly("offset_m", ArrayOf(&Limb::p_PJ))
      .def_property_readonly("rest", ArrayOf(&Limb::R_PJ));
  py::class_<Effector>(module, "Effector", "The free end of a limb, for which a target is set.")
      .def(py::init([](std::string name, int limb, const Array& offset_m) {
             Effector effector{.name = std::move(name), .limb = limb};
             SetVector(&Effector::p_LE, "offset_m")(effector, offset_m);
             return effector;
           }),
           "name"_a, "limb"_a, "offset_m"_a)
      .def_readonly("name", &Effector::name)
      .def_readonly("limb", &Effector::limb)
      .def_property_readonly("offset_m", ArrayOf(&Effector::p_LE));
  py::class_<Tree>(module, "Tree", "Any tree of joints.")
      .def(py::init([](std::vector<Limb> limbs, std::vector<Effector> effectors, const Array& limits) {
             Tree tree{std::move(limbs), std::move(effectors), {}};
             Expect("limits", limits, {kAny, 2});
             for (py::ssize_t i = 0; i < limits.shape(0); ++i)
               tree.limits.push_back({limits.at(i, 0), limits.at(i, 1)});
             return tree;
           }),
           "limbs"_a, "effectors"_a, "limits"_a,
           "limits: (lower, upper) of each degree of freedom, radians, limb after limb.")
      .def_readonly("limbs", &Tree::limbs)
      .def_readonly("effectors", &Tree::effectors)
      .def_property_readonly("limits", [](const Tree& tree) {
        Array limits({static_cast<py::ssize_t>(tree.limits.size()), py::ssize_t{2}});
        double* value = limits.mutable_data();
        for (const AngleRange& range : tree.limits) *value++ = range.lower, *value++ = range.upper;
        return limits;
      });
  module.def("adult_body", &AdultBody, "A person of usual build: 15 limbs, 29 degrees of freedom, 4 effectors.");

  py::class_<Solved>(module, "Solved", "Answers to many problems of inverse kinematics.")
      .def_readonly("angles", &Solved::angles, "problems x degrees of freedom, radians")
      .def_readonly("statuses", &Solved::statuses, "an index of `STATUSES` per problem")
      .def_readonly("iterations", &Solved::iterations);
  module.attr("STATUSES") = py::make_tuple("converged", "stalled", "unreachable", "iteration_limit", "bad_input");

  py::class_<Kinematics>(module, "Kinematics", "Forward and inverse kinematics of one tree.")
      .def(py::init([](std::optional<Tree> tree, int max_iterations, double position_goal_m, double axis_goal,
                       std::optional<double> most_change) {
             return std::make_unique<Kinematics>(tree ? *std::move(tree) : AdultBody(),
                                                 IkOptions{max_iterations, position_goal_m, axis_goal, most_change});
           }),
           "tree"_a = py::none(), "max_iterations"_a = IkOptions{}.max_iterations,
           "position_goal_m"_a = IkOptions{}.position_goal, "axis_goal"_a = IkOptions{}.axis_goal,
           "most_change"_a = py::none(),
           "tree: adult_body() by default. A pose has converged within position_goal_m and axis_goal (radians). "
           "most_change: largest change of an angle from its start, radians. Raises BadInput if it is not a tree.")
      .def_property_readonly("tree", &Kinematics::tree)
      .def_property_readonly("dofs", &Kinematics::dofs)
      .def(
          "limbs",
          [](const Kinematics& body, const Array& angles, const std::optional<Array>& places,
             const std::optional<Array>& axes) {
            return FramesOfPoses(body, &Kinematics::Limbs, body.tree().limbs.size(), angles, places, axes);
          },
          "angles"_a, "root_positions_m"_a = py::none(), "root_axes"_a = py::none(),
          "Positions and axes of all limbs of many poses: (poses x limbs x 3 metres, poses x limbs x 3 x 3 axes as "
          "columns). angles: poses x degrees of freedom, radians. The root: one for all, or one a pose; the world's "
          "frame by default.")
      .def(
          "effectors",
          [](const Kinematics& body, const Array& angles, const std::optional<Array>& places,
             const std::optional<Array>& axes) {
            return FramesOfPoses(body, &Kinematics::Effectors, body.tree().effectors.size(), angles, places, axes);
          },
          "angles"_a, "root_positions_m"_a = py::none(), "root_axes"_a = py::none(),
          "The same as `limbs`, for the effectors.")
      .def(
          "solve",
          [](const Kinematics& body, const Array& starts, const Array& targets_m,
             const std::optional<Array>& target_axes, const std::optional<Array>& position_weights,
             const std::optional<Array>& axis_weights, const std::optional<Array>& root_positions_m,
             const std::optional<Array>& root_axes, bool single_precision) {
            return Solve(body, starts, targets_m, target_axes, position_weights, axis_weights, root_positions_m,
                         root_axes, single_precision ? Precision::kFloat : Precision::kDouble);
          },
          "start_angles"_a, "target_positions_m"_a, "target_axes"_a = py::none(), "position_weights"_a = py::none(),
          "axis_weights"_a = py::none(), "root_positions_m"_a = py::none(), "root_axes"_a = py::none(), py::kw_only(),
          "single_precision"_a = false,
          "Solves many problems. start_angles: problems x degrees of freedom, radians; target_positions_m: problems x "
          "effectors "
          "x 3; target_axes: problems x effectors x 3 x 3, columns, None where positions alone count; weights: "
          "effectors, and "
          "effectors x 3. Numbers that are not finite make that problem 'bad_input'. Raises BadInput for other "
          "shapes.");
}

}  // namespace etude::engine
