#include "tests/reports/support/example_run.h"

#include <fmt/core.h>

#include <cmath>

#include "bench/model/recording.h"
#include "bench/recordings/capture_extras.h"

namespace etude {
namespace {

constexpr int kTrials = 12;

struct MethodPlan {
  std::string method;
  double median;
  double half_width;
  int broken = 0;  ///< number of cells that fail
};

MetricSummary Summary(const std::string& id, double median, double half_width, int present, int missing) {
  return {.id = id,
          .present = present,
          .missing = missing,
          .median = median,
          .mean = median * 1.04,
          .ci_low = median - half_width,
          .ci_high = median + half_width};
}

Comparison Compared(const std::string& metric, const std::string& baseline, const MethodPlan& plan, double difference,
                    double half_width, Verdict verdict) {
  Comparison comparison;
  comparison.metric = metric;
  comparison.baseline = baseline;
  comparison.method = plan.method;
  comparison.pairs = comparison.differing = kTrials - plan.broken;
  comparison.only_baseline = plan.broken;
  comparison.difference = comparison.mean = difference;
  comparison.ci_low = comparison.mean_low = difference - half_width;
  comparison.ci_high = comparison.mean_high = difference + half_width;
  comparison.interval = IntervalKind::kBca;
  comparison.signed_rank = {0.0009765625, "exact"};
  comparison.sign_flip = {0.0025, "exact"};
  comparison.p_holm = 0.0117;
  comparison.share_better = 0.75;
  comparison.effect_size = 0.82;
  comparison.verdict = verdict;
  if (plan.broken > 0) comparison.notes = {"2 of 12 worlds have no pair <script>"};
  return comparison;
}

void AddCells(RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition, const MethodPlan& plan,
              const std::string& failure) {
  for (int trial = 0; trial < kTrials; ++trial) {
    Row row;
    row.scenario = scenario.name;
    row.task = scenario.task;
    row.condition = condition.condition;
    row.trial = trial;
    row.clip = scenario.task == "ik" ? "" : "builtin:clap";
    row.method = plan.method;
    row.result.status = trial < plan.broken ? Status::kFailed : Status::kOk;
    row.result.reason = trial < plan.broken ? failure : "";
    for (const std::string& metric : scenario.headline_metrics) {
      if (trial < plan.broken) {
        row.result.Missing(metric, failure);
      } else {
        row.result.Measure(metric, plan.median * (0.8 + 0.4 * trial / (kTrials - 1)));
      }
    }
    run.rows.push_back(std::move(row));
  }
}

void AddCondition(RunData& run, ScenarioSummary& scenario, std::vector<SweptValue> condition,
                  const std::vector<MethodPlan>& plans, const std::vector<Verdict>& verdicts,
                  const std::string& failure) {
  ConditionSummary summary{.condition = std::move(condition)};
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const MethodPlan& plan = plans[i];
    MethodSummary method;
    method.method = plan.method;
    method.statuses = {{Status::kOk, kTrials - plan.broken}};
    method.ok = kTrials - plan.broken;
    method.attempted = kTrials;
    method.ok_low = 0.5;
    method.ok_high = 1;
    if (plan.broken > 0) method.statuses.emplace_back(Status::kFailed, plan.broken);
    for (const std::string& metric : scenario.headline_metrics) {
      method.metrics.push_back(Summary(metric, plan.median, plan.half_width, kTrials - plan.broken, plan.broken));
    }
    summary.methods.push_back(std::move(method));
    if (i == 0) continue;
    const double difference = plan.median - plans[0].median;
    const double half = plans[0].half_width + plan.half_width;
    for (const std::string& metric : scenario.headline_metrics) {
      summary.comparisons.push_back(Compared(metric, plans[0].method, plan, difference, half, verdicts[i - 1]));
    }
    AddCells(run, scenario, summary, plan, failure);
  }
  AddCells(run, scenario, summary, plans[0], failure);
  scenario.conditions.push_back(std::move(summary));
}

void AddIk(RunData& run) {
  ScenarioSummary scenario{"ik-weights",
                           "ik",
                           "Does updating the weights at every step lower the final orientation error?",
                           SamplingUnit::kWorld,
                           {"fixed", "fixed-tuned", "adaptive", "adaptive-power"},
                           {"orientation_error_deg", "position_error_cm"},
                           {},
                           {},
                           2};
  for (const double noise : {5.0, 10.0, 20.0}) {
    const double k = noise / 10;
    AddCondition(run, scenario, {{"joint_noise_deg", fmt::format("{}", noise)}},
                 {{"fixed", 14.2 * k, 1.1},
                  {"fixed-tuned", 1.3 * k, 0.3},
                  {"adaptive", 2.4 * k, 0.4},
                  {"adaptive-power", 0.8 * k, 0.2}},
                 {Verdict::kBetter, Verdict::kBetter, Verdict::kBetter}, "");
  }
  scenario.expectations = {
      {"orientation_error_deg of adaptive below fixed", ClaimOutcome::kMet, "median −11.8°, 99 % CI −13.0 to −10.4"},
      {"position_error_cm of adaptive at most 1.0 (p95)", ClaimOutcome::kUnmet, "p95 is 1.31"}};
  const double rates[] = {0.02, 0.06, 0.05, 0.09};
  for (const Row& row : run.rows) {
    if (row.scenario != scenario.name) continue;
    CellSeries series{row.Id(), {{"orientation_error_deg", "iteration", {}}}};
    for (std::size_t m = 0; m < scenario.methods.size(); ++m) {
      for (int i = 0; row.method == scenario.methods[m] && i < 160; ++i) {
        series.series[0].values.push_back(0.01 + 38 * std::exp(-rates[m] * i) * (1 + 0.02 * row.trial));
      }
    }
    run.series.push_back(std::move(series));
  }
  run.scenarios.push_back(std::move(scenario));
}

void AddTransition(RunData& run) {
  ScenarioSummary scenario{"transition",
                           "transition",
                           "How smoothly does the coach change from one move to another?",
                           SamplingUnit::kClipPair,
                           {"now", "wait-for-end", "fuzzy-bridge", "fuzzy-bridge-adaptive", "gate-inertialised"},
                           {"jump_cm", "wait_s"},
                           {},
                           {},
                           2};
  AddCondition(run, scenario, {},
               {{"now", 48.7, 6.2},
                {"wait-for-end", 50.1, 7.0},
                {"fuzzy-bridge", 29.6, 4.8, 2},
                {"fuzzy-bridge-adaptive", 24.1, 4.1, 2},
                {"gate-inertialised", 6.4, 0.7}},
               {Verdict::kUndecided, Verdict::kBetter, Verdict::kBetter, Verdict::kBetter},
               "no bridge frame of “sway” has a partner, not even through the in-between clip");
  scenario.expectations = {{"jump_cm of fuzzy-bridge below now", ClaimOutcome::kMet, "median −19.1 cm, CI −24.0 to −13.2"}};
  run.scenarios.push_back(std::move(scenario));
}

void AddDetection(RunData& run) {
  ScenarioSummary scenario{"detection",
                           "detection",
                           "Does trusting well-seen joints more find more of the right moves?",
                           SamplingUnit::kClip,
                           {"fixed", "adaptive"},
                           {"f1", "latency_s"},
                           {},
                           {},
                           2};
  AddCondition(run, scenario, {}, {{"fixed", 0.81, 0.03}, {"adaptive", 0.815, 0.03}}, {Verdict::kNoDifference}, "");
  scenario.expectations = {{"f1 of adaptive at least 0.7", ClaimOutcome::kMet, "median 0.815"},
                           {"latency_s of adaptive below fixed", ClaimOutcome::kUndecided, "half of the values are missing"}};
  run.scenarios.push_back(std::move(scenario));
}

void AddCapture(RunData& run) {
  ScenarioSummary scenario{"capture",
                           "capture",
                           "How close does two-camera capture come to the true motion, before and after IK?",
                           SamplingUnit::kClip,
                           {"before-ik", "ccd-fixed", "ccd-adaptive"},
                           {"mpjpe_mm", "limb_direction_error_deg"},
                           {},
                           {},
                           2};
  AddCondition(run, scenario, {},
               {{"before-ik", 71.4, 6.0}, {"ccd-fixed", 64.0, 9.5, 1}, {"ccd-adaptive", 47.8, 5.2, 1}},
               {Verdict::kUndecided, Verdict::kBetter}, "frame 31: the left hand's mark was found in one picture only");
  run.scenarios.push_back(std::move(scenario));
}

BodyPose Standing() {
  BodyPose pose;
  const auto put = [&](Role role, double x, double y, double z) { pose[role] = {x, y, z}; };
  put(Role::kHipCentre, 0, 0.90, 0);
  put(Role::kSpine, 0, 1.08, 0);
  put(Role::kShoulderCentre, 0, 1.40, 0);
  put(Role::kHead, 0, 1.62, 0);
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](Role left) { return side > 0 ? left : Mirrored(left); };
    put(of(Role::kLeftShoulder), 0.18 * side, 1.38, 0);
    put(of(Role::kLeftHip), 0.09 * side, 0.88, 0);
    put(of(Role::kLeftKnee), 0.10 * side, 0.47, 0.01);
    put(of(Role::kLeftAnkle), 0.10 * side, 0.07, 0);
    put(of(Role::kLeftFoot), 0.12 * side, 0.03, 0.18);
  }
  return pose;
}

/// Returns arms raised outwards by `raise` and bent forward by `bend`, radians; the body sways a little.
BodyPose Dancing(double raise, double bend, double sway) {
  BodyPose pose = Standing();
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](Role left) { return side > 0 ? left : Mirrored(left); };
    const glm::dvec3 upper{side * std::sin(raise), -std::cos(raise), 0};
    const glm::dvec3 lower{side * std::sin(raise + bend), -std::cos(raise + bend), 0.3};
    pose[of(Role::kLeftElbow)] = pose[of(Role::kLeftShoulder)] + 0.29 * upper;
    pose[of(Role::kLeftWrist)] = pose[of(Role::kLeftElbow)] + 0.25 * glm::normalize(lower);
    pose[of(Role::kLeftHand)] = pose[of(Role::kLeftWrist)] + 0.17 * glm::normalize(lower);
  }
  for (const Role role : AllRoles()) pose[role].x += sway * pose[role].y;
  return pose;
}

Recording CoachRecording() {
  BodyMotion coach;
  for (int frame = 0; frame < 165; ++frame) {
    const double t = frame / 30.0;
    coach.poses.push_back(frame < 80 ? Dancing(1.2 + 0.9 * std::sin(4 * t), 0.4, 0.02 * std::sin(2 * t))
                                     : Dancing(0.5, 1.2 + 0.8 * std::sin(5 * t), 0.12 * std::sin(3 * t)));
  }
  return {
      {{"coach", coach}},
      R"({"transition_frame": 80, "from": "clap", "to": "side kick", "branch": "matched in the front half", "distance": 0.31})"};
}

/// Returns a coach that follows one clip until `first`, an in-between until `second`, and then the wanted clip.
BodyMotion WithTransition(int first, int second) {
  BodyMotion coach;
  for (int frame = 0; frame < 150; ++frame) {
    const double t = frame / 30.0;
    coach.poses.push_back(frame <= first    ? Dancing(1.2 + 0.9 * std::sin(4 * t), 0.4, 0.02 * std::sin(2 * t))
                          : frame <= second ? Dancing(0.3, 0.2, 0)
                                            : Dancing(0.5, 1.2 + 0.8 * std::sin(5 * t), 0.12 * std::sin(3 * t)));
  }
  return coach;
}

constexpr std::string_view kWeights =
    R"({"RH":1,"LH":1,"RHE":1,"LHE":1,"Posture":1,"Trunk":1,"RF":0.5,"LF":0.5,"RFK":0.5,"LFK":0.5})";

/// Returns ten partial distances with the sum 2.5 × `unit`.
std::string Partials(double unit) {
  return fmt::format(R"({{"RH":{},"LH":{},"RHE":0,"LHE":0,"Posture":0,"Trunk":0,"RF":{},"LF":0,"RFK":0,"LFK":0}})",
                     unit, unit, unit / 2);
}

Recording Explained(int first, int second, const std::string& rest) {
  return {
      {{"coach", WithTransition(first, second)}},
      fmt::format(R"({{"request_frame": 60, "transition_frame": {}, "from": "builtin:clap", "to": "builtin:side_kick",)"
                  R"( "threshold": 0.4, "natural_limit_cm": 4.5, "weights": {}, {}}})",
                  first, kWeights, rest)};
}

Recording CaptureRecording(std::vector<double>& errors) {
  constexpr int kFrames = 60;
  BodyMotion truth, recovered;
  CaptureExtras extras{.texture_seed = 7};
  for (const double x : {-1.1, 1.1}) {
    extras.views.push_back({LookAt(Intrinsics{}, {x, 1.3, 3.6}, {0, 0.95, 0}), {}, "/9j/4AAQ"});
  }
  for (int frame = 0; frame < kFrames; ++frame) {
    const double t = frame / 30.0;
    truth.poses.push_back(Dancing(1.4 + 0.8 * std::sin(5 * t), 0.3, 0.05 * std::sin(3 * t)));
    recovered.poses.push_back(truth.poses.back());
    double sum = 0;
    for (const Role role : AllRoles()) {
      const glm::dvec3 off = 0.04 * glm::dvec3{std::sin(Index(role) + t), std::cos(2.0 * Index(role)), std::sin(3 * t)};
      recovered.poses.back()[role] += off;
      sum += glm::length(off);
    }
    errors.push_back(1000 * sum / kRoleCount);
    extras.brightness.push_back(1.0);
    for (auto& view : extras.views) {
      Mask mask(320, 240);
      for (const Role role : AllRoles()) {
        const auto pixel = Project(MatrixOf(view.truth), truth.poses.back()[role]);
        for (int dy = -9; dy <= 9; ++dy) {
          for (int dx = -9; dx <= 9; ++dx) {
            const int x = static_cast<int>(pixel->x / 2) + dx, y = static_cast<int>(pixel->y / 2) + dy;
            if (dx * dx + dy * dy <= 81 && mask.Contains(x, y)) mask.At(x, y) = 1;
          }
        }
      }
      view.masks.push_back(std::move(mask));
    }
  }
  return {{{"truth", truth}, {"recovered", recovered}}, WriteCaptureExtras(extras)};
}

std::string CellOf(const RunData& run, const std::string& scenario, const std::string& method, int trial) {
  for (const Row& row : run.rows) {
    if (row.scenario == scenario && row.method == method && row.trial == trial) return row.Id();
  }
  return "";
}

}  // namespace

RunData ExampleRun() {
  RunData run{.suite = "quick", .seed = 1, .program_version = "0.1.0"};
  run.command_line = "etude run scenarios/quick -o out/quick-1";
  run.host = "Debian 12, 2 × x86-64, 4 GB";
  run.wall_seconds = 41.7;
  AddTransition(run);
  AddDetection(run);
  AddIk(run);
  AddCapture(run);
  return run;
}

void AddRecordings(RunData& run) {
  std::vector<double> errors;
  run.recordings.push_back({CellOf(run, "transition", "gate-inertialised", 5), CoachRecording()});
  const std::string capture = CellOf(run, "capture", "ccd-adaptive", 5);
  run.recordings.push_back({capture, CaptureRecording(errors)});
  run.series.push_back({capture, {{"mpjpe_mm", "frame", std::move(errors)}}});
}

void AddTransitions(RunData& run) {
  constexpr int kTrial = 7;
  const auto add = [&](const std::string& method, Recording recording) {
    run.recordings.push_back({CellOf(run, "transition", method, kTrial), std::move(recording)});
  };
  add("now", Explained(60, 60,
                       fmt::format(R"("branch": "now", "wait_s": 0, "why": "It asks nothing & <changes> at once.",)"
                                   R"( "distance": 0.5, "partials": {})",
                                   Partials(0.1))));
  add("fuzzy-bridge",
      Explained(
          70, 85,
          fmt::format(
              R"("transition_frames": [70, 85], "branch": "in-between", "wait_s": 0.8333, "pairs_seen": 40,)"
              R"( "pairs_matched": 0, "why": "No pair was close enough, so it goes through an in-between.",)"
              R"( "transition_points": [{{"from": "builtin:clap", "from_frame": 30, "to": "in-between", "to_frame": 0,)"
              R"( "distance": 0.3, "partials": {}}}, {{"from": "in-between", "from_frame": 14,)"
              R"( "to": "builtin:side_kick", "to_frame": 2, "distance": 0.35, "partials": {}}}])",
              Partials(0.036), Partials(0.049))));
  add("gate-inertialised",
      Explained(
          68, 68,
          fmt::format(
              R"("branch": "front half", "wait_s": 0.2667, "why": "Of 3 pairs, it is the nearest.",)"
              R"( "pairs_seen": 120, "pairs_matched": 3, "cost_unit": "cm", "transition_points": [{{"from": "builtin:clap",)"
              R"( "from_frame": 28, "to": "builtin:side_kick", "to_frame": 4, "distance": 0.2, "partials": {}}}],)"
              R"( "candidates": [{{"from_frame": 27, "to_frame": 3, "distance": 0.25, "partials": {}, "cost": 14.5,)"
              R"( "outcome": "worse"}}, {{"from_frame": 28, "to_frame": 4, "distance": 0.2, "partials": {},)"
              R"( "cost": 9.25, "outcome": "taken"}}, {{"from_frame": 29, "to_frame": 4, "distance": 0.5,)"
              R"( "partials": {}, "cost": null, "outcome": "too far"}}])",
              Partials(0.016), Partials(0.025), Partials(0.016), Partials(0.1))));
}

}  // namespace etude
