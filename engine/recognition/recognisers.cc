#include "engine/recognition/recognisers.h"

#include <algorithm>

#include "engine/base/named.h"
#include "engine/recognition/example_recognisers.h"
#include "engine/recognition/key_pose.h"
#include "engine/recognition/learnt_model.h"
#include "engine/recognition/whole_body.h"

namespace etude {
namespace {

template <typename Own>
using TeachWithOwn = std::unique_ptr<Recogniser> (*)(std::span<const TaughtMove>, const TrackingWeights&, const Own&);

// Adds the options of one recogniser to its kind; `table` lists the options that can be set, with their keys and
// ranges.
template <typename Own>
RecogniserKind WithSettings(RecogniserKind kind, TeachWithOwn<Own> teach, const SettingTable<Own>& table) {
  kind.settings = table.Describe();
  kind.teach = [teach, table](std::span<const TaughtMove> taught, const RecogniserOptions& options) {
    return teach(taught, options.weights, table.Apply(options.settings));
  };
  return kind;
}

Result<void> CheckKeyPoses(const TaughtMove& move) {
  if (move.poses.empty()) return Fail({}, "move '{}' has no key pose", move.name);
  for (const TaughtPose& pose : move.poses) {
    if (pose.targets.empty()) return Fail({}, "a key pose of move '{}' has no target", move.name);
    if (pose.targets.size() > kFeatureCount) {
      return Fail({}, "a key pose of move '{}' has {} targets; allowed: at most {}", move.name, pose.targets.size(),
                  kFeatureCount);
    }
    const auto is_usable = [](const PoseTarget& target) { return target.tolerance_deg > 0; };
    if (!std::ranges::all_of(pose.targets, is_usable)) {
      return Fail({}, "a target of move '{}' has no tolerance above 0", move.name);
    }
  }
  return {};
}

Result<void> CheckExamples(const TaughtMove& move) {
  const auto shows_a_body = [](const SkeletonStream& stream) {
    return stream.rate_hz > 0 && std::ranges::any_of(stream.frames, &SensedFrame::body_seen);
  };
  if (std::ranges::any_of(move.examples, shows_a_body)) return {};
  return Fail({}, "move '{}' has no example that shows a body", move.name);
}

Result<void> Check(const RecogniserKind& kind, std::span<const TaughtMove> taught) {
  for (std::size_t i = 0; i < taught.size(); ++i) {
    const TaughtMove& move = taught[i];
    if (FindByName(taught.first(i), move.name)) return Fail({}, "two moves are called '{}'", move.name);
    if (!(move.span_s > 0 && move.span_s <= kMaxSpan)) {
      return Fail({}, "move '{}' lasts {} s; allowed: above 0, up to {} s", move.name, move.span_s, kMaxSpan);
    }
    const auto why = [&](const Error& error) { return Fail({}, "recogniser {}: {}", kind.name, error.message); };
    if (kind.needs_key_poses) {
      if (const auto checked = CheckKeyPoses(move); !checked) return why(checked.error());
    }
    if (kind.needs_examples) {
      if (const auto checked = CheckExamples(move); !checked) return why(checked.error());
    }
  }
  return {};
}

}  // namespace

// To add a recogniser, add a row here. Its options, if any, are a struct in its own header.
std::span<const RecogniserKind> AllRecognisers() {
  static const std::vector<RecogniserKind> recognisers = {
      // These recognisers are taught by key poses.
      WithSettings<KeyPoseOptions>(
          {.name = "key-pose",
           .description = "paper A's method: checks that the key poses of the move occur in their order",
           .needs_key_poses = true},
          MakeKeyPoseRecogniser,
          {{{"tolerance_scale", &KeyPoseOptions::tolerance_scale, 0.1, 5,
             "Factor on every tolerance of the key poses."},
            {"pose_share", &KeyPoseOptions::pose_share, 0.01, 1,
             "Weighted fraction of the angles of a key pose that must be within their tolerances."},
            {"hold_frames", &KeyPoseOptions::hold_frames, 1, 30,
             "Number of successive frames in which the body must match a key pose."}}}),
      WithSettings<FuzzyRulesOptions>({.name = "fuzzy-rules",
                                       .description = "fuzzy rules on paper A's features: one rule for each key pose, "
                                                      "and one rule for the order of the key poses",
                                       .needs_key_poses = true},
                                      MakeFuzzyRulesRecogniser,
                                      {{{"hold_frames", &FuzzyRulesOptions::hold_frames, 1, 30,
                                         "Number of successive frames in which a rule must hold."}}}),
      // These recognisers are taught by examples.
      WithSettings<DtwOptions>(
          {.name = "dtw",
           .description = "dynamic time warping of joint positions to the taught examples",
           .needs_examples = true},
          MakeDtwRecogniser,
          {{{"half_at_cm", &DtwOptions::half_at_cm, 1, 100, "Distance at which the evidence is one half."}}}),
      {.name = "nearest",
       .description = "nearest neighbour of joint positions among the examples, their mirror images, copies with half "
                      "the amplitude, other moves and standing",
       .needs_examples = true,
       .teach = [](std::span<const TaughtMove> taught,
                   const RecogniserOptions& options) { return MakeNearestRecogniser(taught, options.weights); }},
      {.name = "learnt",
       .description = "ours: aligns limbs with the taught examples, and judges the differences by a model learnt from "
                      "simulated people",
       .needs_examples = true,
       .teach =
           [](std::span<const TaughtMove> taught, const RecogniserOptions& options) {
             return MakeLearntRecogniser(taught, options.weights, BuiltinLearntModel());
           }},
      {.name = "coached",
       .description = "ours: like `learnt`, but for moves that a coach requests in time with the music; the model is "
                      "learnt from simulated people who follow a coach",
       .needs_examples = true,
       // In a test with 32 simulated adults, 0.2 right performances per minute were missed at this threshold.
       .threshold = 0.25,
       .teach =
           [](std::span<const TaughtMove> taught, const RecogniserOptions& options) {
             return MakeLearntRecogniser(taught, options.weights, BuiltinCoachedModel());
           }},
      {.name = "whole-body",
       .description = "ours, for recorded people: judges like `learnt`, and recognises sides and moves by the three "
                      "examples with the nearest whole-body poses",
       .needs_examples = true,
       .teach = [](std::span<const TaughtMove> taught, const RecogniserOptions& options) {
         return MakeWholeBodyRecogniser(taught, options.weights,
                                        MakeLearntRecogniser(taught, options.weights, BuiltinLearntModel()));
       }}};
  return recognisers;
}

std::vector<std::string> RecogniserNames() { return NamesOf(AllRecognisers()); }

const RecogniserKind* FindRecogniser(std::string_view name) { return FindByName(AllRecognisers(), name); }

const RecogniserKind& RecommendedRecogniser(std::span<const TaughtMove> taught, bool by_a_coach) {
  const bool has_examples =
      std::ranges::all_of(taught, [](const TaughtMove& move) { return CheckExamples(move).has_value(); });
  const bool has_several =
      std::ranges::all_of(taught, [](const TaughtMove& move) { return move.examples.size() >= kExamplesOfWholeBody; });
  return *FindRecogniser(!has_examples ? "key-pose" : by_a_coach ? "coached" : has_several ? "whole-body" : "learnt");
}

Result<std::unique_ptr<Recogniser>> MakeRecogniser(const RecogniserOptions& options,
                                                   std::span<const TaughtMove> taught) {
  RETURN_IF_ERROR(Check(*options.kind, taught));
  return options.kind->teach(taught, options);
}

}  // namespace etude
