#include "bench/tasks/detection/train_recogniser.h"

#include <algorithm>
#include <array>
#include <map>

#include "engine/recognition/measuring_recogniser.h"
#include "engine/recognition/sight.h"

namespace etude {
namespace {

/// The measures of a performance that may have ended in frame `frame` of the session.
struct Measured {
  PerformanceOrigin occasion;
  std::size_t move;
  int frame;
  PerformanceMeasures measures;
};

/// Collects labelled bags of performances by key. Each bag keeps only the performances nearest to the move.
class BagMaker {
 public:
  void Add(const std::array<int, 3>& key, bool is_right, const PerformanceMeasures& performance) {
    LabelledBag& bag = bags_[key];
    bag.is_right = is_right;
    bag.performances.push_back(performance);
  }

  void Into(std::vector<LabelledBag>& all) {
    for (auto& [key, bag] : bags_) {
      KeepNearest(bag.performances);
      all.push_back(std::move(bag));
    }
    bags_.clear();
  }

 private:
  std::map<std::array<int, 3>, LabelledBag> bags_;
};

DetectionOptions DrawCondition(const WorldKey& key) {
  RandomStream dice(key, "condition");
  constexpr std::array<double, 4> kNoises = {0.5, 1, 1, 2};
  constexpr std::array<double, 5> kTurns = {0, 0, 0, 30, 60};
  DetectionOptions options;
  options.session.events = 16;
  options.noise = kNoises[dice.IndexBelow(kNoises.size())];
  const double turn_deg = kTurns[dice.IndexBelow(kTurns.size())];
  options.turn_deg = dice.Chance(0.5) ? turn_deg : -turn_deg;
  if (dice.Chance(0.5)) options.sensor = SensorV1();
  if (dice.Chance(0.25)) options.distance_m = dice.Uniform(1.5, 4.5);
  return options;
}

/// Runs a measuring recogniser over the session, and returns the recogniser's measures.
std::vector<Measured> MeasureSession(const DetectionWorld& world, const Repertoire& repertoire,
                                     const TrackingWeights& weights) {
  std::vector<Measured> measured;
  int frame = 0;
  const auto recogniser = MakeMeasuringRecogniser(
      repertoire.taught, weights, [&](PerformanceOrigin occasion, std::size_t move, const PerformanceMeasures& measures) {
        measured.push_back({occasion, move, frame, measures});
        return 0.0;
      });
  const auto follower = recogniser->Follow(world.stream.rate_hz);
  LiveSight sight({}, world.stream.rate_hz);
  auto event = world.events.begin();
  for (const SensedFrame& sensed : world.stream.frames) {
    if (event != world.events.end()) {
      const FrameInterval& window = event->window;
      if (frame == window.begin) follower->Ask(repertoire.IndexOf(event->move));
      if (frame == window.end) {
        follower->Ask(std::nullopt);
        ++event;
      }
    }
    follower->Update(sight.Update(sensed));
    ++frame;
  }
  return measured;
}

/// Returns the index of the event whose window contains the frame; −1 if there is none.
int EventAt(int frame, const DetectionWorld& world) {
  for (std::size_t i = 0; i < world.events.size(); ++i) {
    const FrameInterval& window = world.events[i].window;
    if (frame >= window.begin && frame < window.end) return static_cast<int>(i);
  }
  return -1;
}

/// Sorts the measured performances into bags (sets with one label, multiple-instance learning). For judging, there is
/// one bag per event. For spotting, there is one bag per event and move. The time in which a move is not performed also
/// gives bags: one per second and move, with the label "wrong".
void AddSession(const DetectionWorld& world, const Repertoire& repertoire, const std::vector<Measured>& measured,
                std::vector<LabelledBag>& asked, std::vector<LabelledBag>& spotted) {
  BagMaker asked_bags, spotted_bags;
  for (const Measured& each : measured) {
    const int index = EventAt(each.frame, world);
    const DetectionEvent* event = index >= 0 ? &world.events[static_cast<std::size_t>(index)] : nullptr;
    const std::string& name = repertoire.taught[each.move].name;
    const bool is_asked_for = event != nullptr && event->move == name;
    const bool is_danced = event != nullptr && event->danced == name;
    const bool is_grey = event != nullptr && event->truth == Truth::kGrey;
    if (each.occasion == PerformanceOrigin::kAsked) {
      if (!is_grey && event != nullptr) asked_bags.Add({index, 0, 0}, event->IsRight(), each.measures);
    } else if (is_asked_for || is_danced) {
      if (!is_grey && is_asked_for)
        spotted_bags.Add({index, static_cast<int>(each.move), 0}, event->IsRight(), each.measures);
    } else {
      const int second = each.frame / static_cast<int>(world.stream.rate_hz);
      spotted_bags.Add({-1, static_cast<int>(each.move), second}, false, each.measures);
    }
  }
  asked_bags.Into(asked);
  spotted_bags.Into(spotted);
}

}  // namespace

void KeepNearest(std::vector<PerformanceMeasures>& performances) {
  constexpr std::size_t kMaxPerBag = 12;
  std::ranges::stable_sort(performances, {}, [](const auto& each) { return each[kDistanceMeasure]; });
  performances.resize(std::min(performances.size(), kMaxPerBag));
}

LearntModel TrainRecogniser(const Repertoire& repertoire, const RecogniserTraining& training) {
  std::vector<LabelledBag> asked, spotted;
  for (int session = 0; session < training.sessions; ++session) {
    const WorldKey key{.suite_seed = training.seed, .scenario = "recogniser-training", .trial = session};
    const DetectionWorld world = MakeDetectionWorld(repertoire, DrawCondition(key), key);
    const TrackingWeights weights{.weighting = session % 2 == 0 ? Weighting::kFixed : Weighting::kAdaptive};
    std::vector<LabelledBag> unused;
    const bool teaches_spotting = 2 * session < training.sessions;
    AddSession(world, repertoire, MeasureSession(world, repertoire, weights), asked,
               teaches_spotting ? spotted : unused);
    if (training.progress) training.progress(static_cast<std::size_t>(session + 1), training.sessions);
  }
  return {.asked = FitBoostedTrees(asked, training.asked), .spotted = FitBoostedTrees(spotted, training.spotted)};
}

}  // namespace etude
