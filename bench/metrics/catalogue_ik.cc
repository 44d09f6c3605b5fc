#include "bench/metrics/catalogue_parts.h"

namespace etude {
namespace {

using enum Direction;
using enum Aggregate;

const MetricInput kEffectors = {"effectors",
                                "per end effector: `position_m` and `target_m`, [x, y, z] in metres; `axes` and "
                                "`target_axes`, three unit vectors [x, y, z] each"};
const MetricInput kAsked = {"asked",
                            "what the world asks for: \"both\" (also where it is left out), \"position\", "
                            "\"orientation\""};
const MetricInput kFound = {"found_deg", "the solved angle of every degree of freedom, degrees"};
const std::vector<MetricInput> kCost = {
    {"iterations", "the solver's own steps"},
    {"max_iterations", "how many it was allowed"},
    {"fk_evaluations", "forward-kinematics passes"},
    {"max_fk_evaluations", "the limit of passes: max_iterations + 1"},
    {"solved", "true when all effectors were within 0.1 cm and 0.1° at the end"},
};

const char* const kNeverNull = "Never: a solution has all its effectors.";
const char* const kUntold = "When a method outside answers without telling what it took.";
const char* const kHalfSolved = "Half of what counts as solved.";
const char* const kSolvedReason = "One world in fifty.";
const char* const kStepsReason = "On easy worlds a few steps more or less are the last step's luck.";

}  // namespace

std::vector<MetricInfo> IkCatalogue() {
  return {
      {.id = "position_error_cm",
       .label = "effector position error",
       .unit = "cm",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.05,
       .definition = "Distance of an end effector to its target, mean over the four effectors.",
       .practical_reason = kHalfSolved,
       .formula = "100 · (1/E) Σₑ ‖pₑ − tₑ‖ with p, t in metres and E = 4 effectors (both hands, head, right foot; the "
                  "left foot is the root). In task capture the same over the recovered frames too: the mean over "
                  "frames of the mean over effectors, where t is the point triangulated from the pictures, not the "
                  "truth; frames held from a neighbour do not count. In task tracking the mean over all frames, too.",
       .null_rule = "Task capture: when no frame was recovered, or the method is one outside, whose stages are not "
                    "seen. Tasks ik and tracking: never.",
       .source = "Paper B, whose tables show every effector; this is their mean.",
       .inputs = {kEffectors}},
      {.id = "position_error_max_cm",
       .label = "worst effector position error",
       .unit = "cm",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.05,
       .definition = "Distance of an end effector to its target, the worst of the four effectors.",
       .practical_reason = kHalfSolved,
       .formula = "100 · maxₑ ‖pₑ − tₑ‖ with p, t in metres.",
       .null_rule = kNeverNull,
       .source = "After paper B; the worst instead of the mean.",
       .inputs = {kEffectors}},
      {.id = "orientation_error_deg",
       .label = "effector orientation error",
       .unit = "deg",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.1,
       .definition =
           "Angle between an effector's axis and its target, mean over three axes, then over the four effectors.",
       .practical_reason = "What counts as solved; a tenth of a degree moves a hand by a third of a millimetre.",
       .formula = "(1/E) Σₑ (1/3) Σₖ ∠(aₑₖ, bₑₖ), degrees; ∠(u, v) = atan2(‖u × v‖, u · v) in [0°, 180°], 0° when "
                  "either vector is zero. It is the mean of three axis angles, not the angle of the rotation between "
                  "the frames: a turn by θ about one axis counts 2θ/3. In task tracking the mean over all frames, too.",
       .null_rule = kNeverNull,
       .source = "Paper B, whose tables show every axis; this is their mean.",
       .inputs = {kEffectors}},
      {.id = "orientation_error_max_deg",
       .label = "worst effector orientation error",
       .unit = "deg",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.1,
       .definition =
           "Angle between an effector's axis and its target, mean over three axes, the worst of the four effectors.",
       .practical_reason = "What counts as solved; a tenth of a degree moves a hand by a third of a millimetre.",
       .formula = "maxₑ (1/3) Σₖ ∠(aₑₖ, bₑₖ), degrees: the mean over an effector's axes first, then the largest "
                  "effector. ∠ as in orientation_error_deg.",
       .null_rule = kNeverNull,
       .source = "After paper B; the worst instead of the mean.",
       .inputs = {kEffectors}},
      {.id = "hidden_angle_error_deg",
       .label = "hidden-angle error",
       .unit = "deg",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.25,
       .definition = "Root mean square, over all degrees of freedom, of the solved minus the true joint angle.",
       .practical_reason = "A quarter of a degree in the shoulder moves the hand by 3 mm.",
       .formula = "√((1/N) Σᵢ δᵢ²) over all N degrees of freedom of the tree, weighted alike; δᵢ = found − true, "
                  "degrees, taken modulo 360° into [−180°, 180°]. In task tracking over the angles of all frames.",
       .null_rule = kNeverNull,
       .source = "Etude: paper B judges the effectors only; the angles between are what its limits are for.",
       .inputs = {kFound, {"true_deg", "the true angles, degrees"}}},
      {.id = "hidden_angle_change_deg",
       .label = "hidden-angle change",
       .unit = "deg",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.25,
       .definition = "Root mean square, over all degrees of freedom, of the solved minus the starting joint angle.",
       .practical_reason = "As hidden_angle_error_deg, with which it is read.",
       .formula = "As hidden_angle_error_deg with the angles that the solver began with instead of the true ones.",
       .null_rule = kNeverNull,
       .source = "Etude: how much of the start a solver keeps (paper B, section 3.7.2, bounds it).",
       .inputs = {kFound, {"start_deg", "the angles that the solver began with, degrees"}}},
      {.id = "solved_practical",
       .label = "solved (0.1 cm, 0.1°)",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.02,
       .definition =
           "1 when all effectors are within 0.1 cm and 0.1° of their targets and no joint limit is broken, else 0.",
       .practical_reason = kSolvedReason,
       .formula =
           "1 if position_error_max_cm < 0.1 and orientation_error_max_deg < 0.1, else 0; exactly at a limit is "
           "0. Of a world that asks for positions only, or for axes only, the other error is not judged. A limit "
           "is broken when an angle lies beyond it by more than 10⁻⁶ degrees, also by a method with `limits: false`. "
           "The denominator of its mean is every world: a method that gave no answer has 0.",
       .null_rule = "Never: no answer is 0.",
       .source = "Etude.",
       .inputs = {kEffectors, kAsked}},
      {.id = "solved_tight",
       .label = "solved (10⁻³ cm, 10⁻³°)",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.02,
       .definition =
           "1 when all effectors are within 0.001 cm and 0.001° of their targets and no joint limit is broken, else 0.",
       .practical_reason = kSolvedReason,
       .formula = "1 if position_error_max_cm < 0.001 and orientation_error_max_deg < 0.001, else 0; exactly at a "
                  "limit is 0. What is asked, joint limits and denominator as in solved_practical.",
       .null_rule = "Never: no answer is 0.",
       .source = "Etude: a hundredth of solved_practical, to see who converges.",
       .inputs = {kEffectors, kAsked}},
      {.id = "limit_violations",
       .label = "joint limits broken",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMean,
       .practical = 0.01,
       .definition = "How many joint angles lie beyond their limits.",
       .practical_reason = "One broken limit in a hundred worlds; there should be none.",
       .formula = "The count of angles i with found_i < lower_i − 10⁻⁶° or found_i > upper_i + 10⁻⁶°: nearer is "
                  "rounding, and exactly there is fine.",
       .null_rule = kNeverNull,
       .source = "Etude: paper B's section 3.7.1 as a check.",
       .inputs = {kFound, {"limits_deg", "[lower, upper] of every degree of freedom, degrees"}}},
      {.id = "iterations",
       .label = "solver steps",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 5,
       .definition = "The solver's own steps until it stopped; the limit when it did not converge.",
       .practical_reason = kStepsReason,
       .formula = "The count of completed steps: 0 when the start already met the goals; for CCD one step is a sweep "
                  "over all joints. A solver that stalls stops early, so few steps are no success: read it with "
                  "solved_practical, or take iterations_par2.",
       .null_rule = kUntold,
       .source = "Paper B counts them.",
       .inputs = kCost},
      {.id = "fk_evaluations",
       .label = "forward-kinematics passes",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 5,
       .definition = "Passes of forward kinematics over the whole tree, comparable across solvers.",
       .practical_reason = kStepsReason,
       .formula = "The count of passes, the start's own included, whether the world was solved or not.",
       .null_rule = kUntold,
       .source = "Etude: steps of different solvers cost differently, passes do not.",
       .inputs = kCost},
      {.id = "iterations_par2",
       .label = "solver steps, unsolved count double (PAR-2)",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMean,
       .practical = 5,
       .definition = "The solver's steps where it solved the world, else twice the limit.",
       .practical_reason = "About one world in a hundred more or less unsolved, at a limit of 200 steps.",
       .formula =
           "iterations if solved_practical is 1 and iterations ≤ max_iterations, else 2 · max_iterations, also for a "
           "method that gave no answer. Its mean over all worlds is PAR-2: no world leaves the denominator.",
       .null_rule = kUntold,
       .source = "Penalised average runtime with factor 2, as in the SAT competitions.",
       .inputs = kCost},
      {.id = "fk_evaluations_par2",
       .label = "forward-kinematics passes, unsolved count double (PAR-2)",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMean,
       .practical = 5,
       .definition = "Forward-kinematics passes where the solver solved the world, else twice the limit.",
       .practical_reason = "About one world in a hundred more or less unsolved, at a limit of 200 steps.",
       .formula = "fk_evaluations if solved_practical is 1 and fk_evaluations ≤ max_fk_evaluations, else 2 · "
                  "max_fk_evaluations, also for a method that gave no answer. The limit is max_iterations + 1 for all "
                  "methods of a scenario: the built-in solvers make one pass before their first step and one in each, "
                  "ccd-anderson and gauss-newton at times a second, which counts against them.",
       .null_rule = kUntold,
       .source = "Penalised average runtime with factor 2, as in the SAT competitions.",
       .inputs = kCost},
  };
}

}  // namespace etude
