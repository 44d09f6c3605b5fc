#include "sim/performer/learner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>
#include <numeric>

#include "engine/base/smoothstep.h"
#include "sim/choreography/canonical_body.h"
#include "sim/performer/rendition.h"

namespace etude {
namespace {

// The amounts of learning are ours; one unit is the learning from one trial with knowledge of results (`Skill`).
// Practice without knowledge of results teaches little, and knowledge of results teaches much: this is the first
// finding of Salmoni, Schmidt and Walter (1984).
constexpr double kPractice = 0.25;
constexpr double kDemonstration = 1;
constexpr double kCorrection = 4;  // units per fault of the corrected performance
constexpr double kWrongPraise = 0.5;

// Guidance (Winstein and Schmidt 1990): feedback makes errors rarer in the next performances, but not permanently.
constexpr double kGuided = 0.5;           // share of errors that are avoided in the first performance after feedback
constexpr double kGuidedLater = 0.5;      // share of this guidance that is left after each further performance
constexpr double kFrequencyMemory = 0.7;  // weight of the past in the running mean of the feedback frequency

// Losses and gains of patience, whose maximum is 1 (ours).
constexpr double kNeedlessCost = 0.15;
constexpr double kWrongPraiseCost = 0.06;
constexpr double kCorrectionCost = 0.02;
constexpr double kPraiseGain = 0.03;

/// The minimum severity of a fault that happens (ours). Many faults of lower severity would be too mild to make a
/// performance wrong.
constexpr double kMinSeverity = 0.35;

/// The probability of each fault for a person without any skill, in the order of Fault (ours).
constexpr std::array<double, 10> kFaultChances = {0.25, 0.10, 0.10, 0.12, 0.15, 0.10, 0.12, 0.12, 0.08, 0.10};
using Proneness = std::array<double, 10>;

/// Draws the probability of each fault in one move for a person without skill. Each person has typical mistakes: in
/// every move two faults are frequent and the other faults are rare (ours).
Proneness DrawProneness(RandomStream& dice, std::span<const GradedFault> showable) {
  constexpr std::array<double, 2> kTypical = {0.45, 0.25};
  constexpr double kSeldom = 0.3;
  Proneness usual{}, proneness{};
  for (const GradedFault& fault : showable)
    usual[static_cast<std::size_t>(fault.fault)] = kFaultChances[static_cast<std::size_t>(fault.fault)];
  for (std::size_t i = 0; i < usual.size(); ++i) proneness[i] = kSeldom * usual[i];
  // Draw two typical faults, with probabilities proportional to the usual frequencies of the faults.
  for (double typical : kTypical) {
    const double all = std::accumulate(usual.begin(), usual.end(), 0.0);
    double left = dice.Uniform() * all;
    if (all == 0) break;  // no further fault can be shown
    std::size_t chosen = 0;
    while (chosen + 1 < usual.size() && (usual[chosen] == 0 || left >= usual[chosen])) left -= usual[chosen++];
    proneness[chosen] = typical;
    usual[chosen] = 0;
  }
  return proneness;
}

/// The mean initial skill and the initial patience of one kind of people (ours).
struct Beginning {
  double skill, patience;
};

Beginning BeginningOf(People kind) {
  switch (kind) {
    case People::kToddler:
      return {0.35, 0.7};
    case People::kSchoolChild:
      return {0.5, 0.85};
    case People::kExpert:
      return {0.97, 1};
    default:
      return {0.6, 1};
  }
}

std::vector<Skill> DrawSkills(RandomStream& dice, const Person& person, const LearnerOptions& options) {
  constexpr double kSpread = 0.15, kFloor = 0.02;
  std::vector<Skill> skills;
  for (std::size_t i = 0; i < AllFaults().size(); ++i) {
    const double drawn = BeginningOf(person.kind).skill + kSpread * std::clamp(dice.Normal(), -2.0, 2.0);
    const double error = 1 - options.skill.value_or(std::clamp(drawn, kFloor, 1 - kFloor));
    skills.emplace_back(options.law, error, std::min(kFloor, error), options.rates);
  }
  return skills;
}

Sway DrawSway(const WorldKey& key) {
  RandomStream dice(key, "learner-sway");
  return Sway(dice);
}

}  // namespace

struct Learner::MoveState {
  std::vector<Skill> skills;  // skills in the order of Fault
  Proneness proneness{};      // probability of each fault for a person without any skill
  std::unique_ptr<Style> style;
  int attempts = 0;
  std::optional<std::size_t> latest;  // index of the latest performance that is over and was not cut
  bool latest_was_corrected = false;
  bool had_feedback = false;      // true after feedback, until the next performance ends
  double feedback_frequency = 0;  // running mean, in [0, 1]
  double guided = 0;              // share of the errors that guidance avoids now

  double ChanceOf(Fault fault) const {
    const auto i = static_cast<std::size_t>(fault);
    return proneness[i] * skills[i].Error() * (1 - guided);
  }
};

struct Learner::Layer {
  std::optional<Rendition> rendition;  // the performance; empty: the body stands
  double seen_s = 0;                   // time at which the person saw the coach's action begin
  double lag_s = 0;
  double blend_s = kBlendSeconds;
  double vigour = 1;
  std::vector<double> beats;  // the beat that the coach showed in each frame
  std::size_t performance = 0;

  double Weight(double time_s) const { return Smootherstep((time_s - seen_s) / blend_s); }

  /// Returns the share of the performance that is due: a person in perfect time has reached the beat that the coach
  /// showed one lag ago. Before the first beat, the share accelerates from rest; after the last shown beat, it grows at
  /// the move's tempo.
  double DueAt(double time_s) const {
    const Move& move = rendition->style().move();
    const double beats_per_s = move.tempo_bpm / 60, length_s = move.beats / beats_per_s;
    const double frame = (time_s - seen_s - lag_s) * kJudgedRateHz;
    const auto last = static_cast<double>(beats.size() - 1);
    double beat = 0;
    if (frame <= 0) {
      beat = beats.front() + frame / kJudgedRateHz * beats_per_s;
    } else if (frame >= last) {
      beat = beats.back() + (frame - last) / kJudgedRateHz * beats_per_s;
    } else {
      const auto i = static_cast<std::size_t>(frame);
      beat = beats[i] + (frame - static_cast<double>(i)) * (beats[i + 1] - beats[i]);
    }
    return EasedTime(beat / beats_per_s, length_s) / length_s;
  }
};

Learner::Learner(const WorldKey& key, const Person& person, std::span<const Move> moves, const ShowableFaults& showable,
                 const LearnerOptions& options)
    : key_(key),
      person_(person),
      moves_(moves),
      showable_(showable),
      options_(options),
      rest_(RestOf(person)),
      sway_(DrawSway(key)),
      patience_(BeginningOf(person.kind).patience) {
  for (std::size_t i = 0; i < moves.size(); ++i) {
    RandomStream dice(key, "learner-skill/" + moves[i].name);
    MoveState& known = known_.emplace_back();
    known.skills = DrawSkills(dice, person, options);
    known.proneness = DrawProneness(dice, showable.Of(i));
  }
  layers_.emplace_back().seen_s = -1;
}

Learner::~Learner() = default;

const Style& Learner::StyleOf(std::size_t move) {
  std::unique_ptr<Style>& style = known_[move].style;
  if (!style) style = std::make_unique<Style>(person_, moves_[move]);
  return *style;
}

const BodyPose& Learner::Step(const Shown& shown) {
  Notice(shown);
  before_ = shown;
  NoteLastKeyBeat();
  pose_ = person_.place.Apply(PoseOf(ControlsNow(), person_.body));
  time_s_ += 1 / kJudgedRateHz;
  if (shown.act == Shown::Act::kDance) danced_s_ += 1 / kJudgedRateHz;
  return pose_;
}

void Learner::Notice(const Shown& shown) {
  using enum Shown::Act;
  const bool goes_on = shown.act == before_.act && shown.move == before_.move && shown.repetition == before_.repetition;
  // If the coach still shows the same performance, record the shown beat.
  if (goes_on) {
    if (shown.act == kDance && layers_.back().rendition) layers_.back().beats.push_back(shown.beat);
  } else {
    // If the coach now shows something else, end the dance; then begin the next dance, or learn from the coach's act.
    if (before_.act == kDance) End();
    if (shown.act == kDance) {
      Begin(shown);
    } else if (before_.act == kDance) {
      Layer& stands = layers_.emplace_back();
      stands.seen_s = time_s_ + person_.lag_s;
    }
    if (shown.act == kCorrect && shown.move >= 0) Correct(static_cast<std::size_t>(shown.move));
    if (shown.act == kDemonstrate && shown.move >= 0) Demonstrate(static_cast<std::size_t>(shown.move));
  }
  if (shown.praises && !before_.praises) Praise();
  // Drop layers that are hidden because a later layer has reached its full weight.
  const auto covers = [&](const Layer& layer) { return layer.Weight(time_s_) >= 1; };
  const auto top = std::find_if(layers_.rbegin(), layers_.rend(), covers);
  if (top != layers_.rend()) layers_.erase(layers_.begin(), top.base() - 1);
}

std::vector<GradedFault> Learner::DrawFaults(RandomStream& dice, std::size_t move, std::size_t& instead) const {
  std::vector<GradedFault> faults;
  const std::span<const GradedFault> showable = showable_.Of(move);
  for (Fault fault : AllFaults()) {
    // Draw the random numbers of every fault, whether it happens or not.
    const double happens = dice.Uniform(), severity = dice.Uniform(), choice = dice.Uniform();
    const std::span<const GradedFault> ways(std::ranges::lower_bound(showable, fault, {}, &GradedFault::fault),
                                            std::ranges::upper_bound(showable, fault, {}, &GradedFault::fault));
    if (ways.empty() || happens >= known_[move].ChanceOf(fault)) continue;
    const auto way = static_cast<std::size_t>(choice * static_cast<double>(ways.size()));
    const double drawn = kMinSeverity + (1 - kMinSeverity) * severity;
    faults.push_back({fault, options_.severity.value_or(drawn), ways[way].choice});
  }
  instead = (move + 1 + dice.IndexBelow(std::max<std::size_t>(1, moves_.size() - 1))) % moves_.size();
  return faults;
}

void Learner::Begin(const Shown& shown) {
  assert(0 <= shown.move && static_cast<std::size_t>(shown.move) < moves_.size());
  const auto index = static_cast<std::size_t>(shown.move);
  const Move& move = moves_[index];
  MoveState& known = known_[index];
  LearnerPerformance& performance = performances_.emplace_back();
  // Open the record of this performance.
  performance.repetition = shown.repetition;
  performance.move = shown.move;
  performance.attempt = known.attempts++;

  // Draw the performance's variation and its faults. A person who is absent or has given up stands still.
  RandomStream dice(key_, fmt::format("learner/{}/{}", move.name, performance.attempt));
  Chance chance = DrawChance(dice, person_);
  chance.tempo = 1;  // the music determines the tempo
  std::size_t instead = 0;
  std::vector<GradedFault> faults = DrawFaults(dice, index, instead);
  const bool stands = HasGivenUp() || person_.kind == People::kAbsent;
  if (stands) faults = {{Fault::kSkipped, 1, 0}};

  // Fill in the event.
  SessionEvent& event = performance.event;
  event.move = event.danced = move.name;
  event.faults = faults;
  event.chance = chance;
  event.start_s = time_s_ - shown.beat * 60 / move.tempo_bpm;
  event.end_s = event.start_s + chance.lag_s + move.beats * 60 / move.tempo_bpm;
  if (stands) event.danced.clear();
  if (std::ranges::find(faults, Fault::kWrongMove, &GradedFault::fault) != faults.end()) {
    event.danced = moves_[instead].name;
  }

  // Put the performance as a new layer over the body's present action, and compute the truth about this performance.
  Layer layer;
  layer.rendition.emplace(StyleOf(index), chance, std::move(faults), &StyleOf(instead));
  layer.seen_s = time_s_;
  layer.lag_s = chance.lag_s;
  // A person with a short lag must also blend quickly.
  layer.blend_s = std::clamp(chance.lag_s + 0.15, 0.2, kBlendSeconds);
  layer.vigour = VigourAfter(person_, danced_s_);
  layer.beats = {shown.beat};
  layer.performance = performances_.size() - 1;
  event.deviation = layer.rendition->Deviation();
  event.truth = TruthOf(event.deviation);
  layers_.push_back(std::move(layer));
}

void Learner::End() {
  LearnerPerformance& performance = performances_.back();
  const Move& move = moves_[static_cast<std::size_t>(performance.move)];
  MoveState& known = known_[static_cast<std::size_t>(performance.move)];
  constexpr double kLastBeats = 0.25;  // beats; more than a frame, so a performance shown to its end is not cut
  performance.is_over = true;
  performance.is_cut = before_.beat < move.beats - kLastBeats;
  performance.event.end_s = time_s_ + performance.event.chance.lag_s;
  if (performance.is_cut || HasGivenUp()) return;

  // Add the learning from practice, and update the share of guidance and the feedback frequency.
  for (Skill& skill : known.skills) skill.Practise(kPractice);
  known.guided *= kGuidedLater;
  known.feedback_frequency =
      kFrequencyMemory * known.feedback_frequency + (1 - kFrequencyMemory) * (known.had_feedback ? 1 : 0);
  known.had_feedback = false;
  known.latest = latest_ = performances_.size() - 1;
  known.latest_was_corrected = false;
}

void Learner::NoteFeedback(std::size_t move) {
  known_[move].had_feedback = true;
  known_[move].guided = kGuided;
}

void Learner::Correct(std::size_t move) {
  MoveState& known = known_[move];
  if (HasGivenUp()) return;
  // A correction without a mistake before it has no effect except that it costs patience.
  const bool follows_mistake =
      known.latest && !known.latest_was_corrected && performances_[*known.latest].event.truth != Truth::kRight;
  if (!follows_mistake) {
    SpendPatience(kNeedlessCost);
    return;
  }
  // Learn to avoid the faults of the corrected performance. After frequent feedback, less is retained.
  known.latest_was_corrected = true;
  const double lasts = 1 - options_.guidance * known.feedback_frequency;
  for (const GradedFault& fault : performances_[*known.latest].event.faults) {
    known.skills[static_cast<std::size_t>(fault.fault)].Learn(kCorrection * lasts);
  }
  NoteFeedback(move);
  SpendPatience(kCorrectionCost);
}

void Learner::Demonstrate(std::size_t move) {
  MoveState& known = known_[move];
  if (HasGivenUp()) return;
  const double lasts = 1 - options_.guidance * known.feedback_frequency;
  for (Skill& skill : known.skills) skill.Learn(kDemonstration * lasts);
  NoteFeedback(move);
}

void Learner::Praise() {
  if (!latest_ || HasGivenUp()) return;
  const LearnerPerformance& praised = performances_[*latest_];
  if (praised.event.truth == Truth::kRight) patience_ = std::min(1.0, patience_ + kPraiseGain);
  if (praised.event.truth != Truth::kWrong) return;
  for (const GradedFault& fault : praised.event.faults) {
    known_[static_cast<std::size_t>(praised.move)].skills[static_cast<std::size_t>(fault.fault)].Unlearn(kWrongPraise);
  }
  SpendPatience(kWrongPraiseCost);
}

void Learner::SpendPatience(double cost) {
  if (options_.gives_up) patience_ = std::max(0.0, patience_ - cost);
}

double Learner::ChanceOfRight(std::size_t move) const {
  double chance = 1;
  for (Fault fault : AllFaults()) chance *= 1 - known_[move].ChanceOf(fault);
  return chance;
}

double Learner::RetainedChanceOfRight(std::size_t move, int performances_later) const {
  double chance = 1;
  for (std::size_t i = 0; i < AllFaults().size(); ++i) {
    Skill rested = known_[move].skills[i];
    rested.Rest(performances_later);
    chance *= 1 - known_[move].proneness[i] * rested.Error();
  }
  return chance;
}

void Learner::NoteLastKeyBeat() {
  for (const Layer& layer : layers_) {
    if (!layer.rendition) continue;
    SessionEvent& event = performances_[layer.performance].event;
    const Move& move = layer.rendition->style().move();
    const bool waits = event.IsRight() && !event.first_right_s && !move.key_poses.empty();
    if (!waits) continue;
    const double share = layer.rendition->DancedShare(layer.DueAt(time_s_));
    if (share * move.beats >= move.key_poses.back().beat) event.first_right_s = time_s_;
  }
}

Controls Learner::ControlsNow() const {
  const Controls standing = Sum(rest_, sway_.At(time_s_));
  Controls controls = standing;
  for (const Layer& layer : layers_) {
    const double weight = layer.Weight(time_s_);
    if (weight <= 0) continue;
    Controls own = standing;
    if (layer.rendition) {
      const double share = layer.rendition->DancedShare(layer.DueAt(time_s_)),
                   presence = layer.rendition->Presence(share);
      if (presence > 0) own = Mix(standing, layer.rendition->Danced(share, layer.vigour), presence);
    }
    controls = weight < 1 ? Mix(controls, own, weight) : own;
  }
  return controls;
}

}  // namespace etude
