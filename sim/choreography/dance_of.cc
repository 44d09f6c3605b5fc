#include "sim/choreography/dance_of.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/named.h"
#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/base/text.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/slow_demonstration.h"

namespace etude {
namespace {

/// A word for the values of a feature that are at most `up_to` degrees (for Posture, on its own scale).
struct Word {
  double up_to;
  std::string_view word;
};
constexpr double kAny = 1e9;

/// The words for one feature, and the part of the body that the feature describes. A value with an empty word is left
/// out of the hint.
struct Vocabulary {
  std::string_view feature;  ///< name of the feature, without the prefix R or L
  std::string_view part;     ///< the part of the body, without "left" or "right"
  std::vector<Word> words;
};
const std::vector<Vocabulary>& Vocabularies() {
  static const std::vector<Vocabulary> vocabularies = {
      {"H", "arm", {{30, "down"}, {75, "half raised"}, {115, "at shoulder height"}, {kAny, "up"}}},
      {"HE", "elbow", {{30, "straight"}, {70, "slightly bent"}, {kAny, "bent"}}},
      {"F", "leg", {{20, ""}, {60, "out"}, {kAny, "raised"}}},
      {"FK", "knee", {{130, "bent"}, {kAny, "straight"}}},
      {"Posture", "", {{70, "crouch"}, {90, ""}, {kAny, "in the air"}}},
      {"Trunk", "", {{165, "bend"}, {kAny, "upright"}}},
  };
  return vocabularies;
}

std::string_view WordFor(const Vocabulary& vocabulary, double degrees) {
  return std::ranges::find_if(vocabulary.words, [&](const Word& word) { return degrees <= word.up_to; })->word;
}

std::optional<double> DegreesOf(const KeyPose& pose, const std::string& feature) {
  const auto found = std::ranges::find(pose.targets, feature, &KeyPose::Target::feature);
  return found != pose.targets.end() ? std::optional(found->degrees) : std::nullopt;
}

/// Describes both sides of one part of the body. If the two sides have the same words, the sides are combined: "both
/// …s".
void SayLimb(const KeyPose& pose, const Vocabulary& vocabulary, std::vector<std::string>& said) {
  const auto word_of = [&](const char* side) {
    const auto degrees = DegreesOf(pose, side + std::string(vocabulary.feature));
    return degrees ? WordFor(vocabulary, *degrees) : std::string_view();
  };
  const std::string_view left = word_of("L"), right = word_of("R");
  if (!left.empty() && left == right) {
    said.push_back(fmt::format("both {}s {}", vocabulary.part, left));
    return;
  }
  if (!left.empty()) said.push_back(fmt::format("left {} {}", vocabulary.part, left));
  if (!right.empty()) said.push_back(fmt::format("right {} {}", vocabulary.part, right));
}

std::string Words(const KeyPose& pose) {
  std::vector<std::string> said;
  for (const Vocabulary& vocabulary : Vocabularies()) {
    if (!vocabulary.part.empty()) {
      SayLimb(pose, vocabulary, said);
    } else if (const auto degrees = DegreesOf(pose, std::string(vocabulary.feature))) {
      const std::string_view word = WordFor(vocabulary, *degrees);
      if (!word.empty()) said.emplace_back(word);
    }
  }
  return Join(said);
}

/// Returns the pose with left and right exchanged in its targets.
KeyPose OtherSide(KeyPose pose) {
  for (KeyPose::Target& target : pose.targets) {
    char& side = target.feature.front();
    if (target.feature == "Trunk" || target.feature == "Posture") continue;
    side = side == 'L' ? 'R' : 'L';
  }
  return pose;
}

Result<DanceMove> DanceMoveOf(const std::string& name) {
  ASSIGN_OR_RETURN(const auto move, LoadBuiltinMove(name));
  ASSIGN_OR_RETURN(auto slow, SlowDemonstration(move));
  return DanceMove{.name = name,
                   .hint = HintOf(move),
                   .key_pose = PoseOf(move.curves.At(move.key_poses.front().beat)),
                   .slow = std::move(slow.motion)};
}

/// Returns the time of every beat, seconds, from the song's beginning to its end.
std::vector<double> BeatsOf(const Song& song) {
  std::vector<double> beats;
  for (int beat = 0; beat * 60 / song.tempo_bpm <= song.motion.DurationSeconds(); ++beat) {
    beats.push_back(beat * 60 / song.tempo_bpm);
  }
  return beats;
}

constexpr double kMinBeatSeconds = 0.2, kMaxBeatSeconds = 3;
constexpr std::size_t kMinBeats = 8, kMaxBeats = 10000;

/// Returns the number in a line's first word; nullopt if the first word is not a number.
std::optional<double> NumberAtFront(std::string_view line) {
  return ParseFinite(line.substr(0, line.find_first_of(" \t\r,;")));
}

/// Returns the time of a beat, which may be fractional, seconds, interpolated linearly between two whole beats.
double MomentOf(double beat, const std::vector<double>& beats_s) {
  const auto before = static_cast<std::size_t>(beat);
  const double share = beat - std::floor(beat);
  return share > 0 ? std::lerp(beats_s[before], beats_s[before + 1], share) : beats_s[before];
}

}  // namespace

std::string HintOf(const Move& move) {
  std::string hint;
  for (std::size_t i = 0; i < move.key_poses.size(); ++i) {
    const std::string words = Words(move.key_poses[i]);
    const bool is_mirrored = i > 0 && Words(OtherSide(move.key_poses[i - 1])) == words;
    hint += fmt::format("{}{}", i > 0 ? "; then " : "", is_mirrored ? "the other side" : words);
  }
  return hint;
}

Result<std::vector<Move>> MovesOf(const Song& song) {
  std::vector<Move> moves;
  for (const SongPart& part : song.parts) {
    if (FindByName(moves, part.move) != nullptr) continue;
    ASSIGN_OR_RETURN(const auto move, LoadBuiltinMove(part.move));
    ASSIGN_OR_RETURN(auto danced, AtTempo(move, part.half_time ? song.tempo_bpm / 2 : song.tempo_bpm, {}));
    moves.push_back(std::move(danced));
  }
  return moves;
}

Result<Dance> DanceOf(const Song& song) {
  Dance dance{.title = song.name,
              .tempo_bpm = song.tempo_bpm,
              .motion = song.motion,
              .moves = {},
              .repetitions = {},
              .tags = song.tags,
              .acts = {},
              .beats_s = BeatsOf(song)};
  std::map<std::string, int> indices;
  std::vector<int> moves;  // the index of the move of each repetition
  // Collect each move once, in the order of first appearance.
  for (const SongPart& part : song.parts) {
    if (!indices.contains(part.move)) {
      indices[part.move] = static_cast<int>(dance.moves.size());
      ASSIGN_OR_RETURN(auto move, DanceMoveOf(part.move));
      dance.moves.push_back(std::move(move));
    }
    moves.insert(moves.end(), part.times, indices[part.move]);
  }
  // Every repetition begins at its tag and ends at the next tag.
  const SongPart& last = song.parts.back();
  const double end_s = (last.start_beat + last.beats) * 60 / song.tempo_bpm;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const auto end = i + 1 < moves.size() ? song.tags[i + 1].frame : static_cast<std::size_t>(end_s * kJudgedRateHz);
    dance.repetitions.push_back({.move = moves[i], .first = song.tags[i].frame, .end = end});
  }
  // Add the coach's acts.
  for (const std::string& name : BuiltinActNames()) {
    ASSIGN_OR_RETURN(auto act, LoadBuiltinMove(name));
    dance.acts.push_back({.name = name, .motion = std::move(act.motion), .loops = act.loops});
  }
  return dance;
}

Result<std::vector<double>> ReadBeats(std::string_view text, const std::string& file) {
  std::vector<double> beats;
  int number = 0;
  while (!text.empty()) {
    // Take the next line.
    const std::string_view line = Trimmed(TakeLine(text));
    ++number;
    if (line.empty() || line.front() == '#') continue;
    // Read the line's time, and compare it with the time of the previous beat.
    const auto moment = NumberAtFront(line);
    if (!moment)
      return Fail({file, number, 1}, "each line must contain the time of a beat in seconds, found {}",
                  Quote(line.substr(0, 40)));
    if (*moment < 0) return Fail({file, number, 1}, "found a beat at {} s; allowed: 0 s or later", *moment);
    const double step = beats.empty() ? kMinBeatSeconds : *moment - beats.back();
    if (step < kMinBeatSeconds - 1e-9 || step > kMaxBeatSeconds) {
      return Fail({file, number, 1}, "found a beat at {} s, {:.3f} s after the previous beat; allowed: {} to {} s",
                  *moment, step, kMinBeatSeconds, kMaxBeatSeconds);
    }
    beats.push_back(*moment);
    if (beats.size() > kMaxBeats) return Fail({file, number, 1}, "more than {} beats", kMaxBeats);
  }
  if (beats.size() < kMinBeats) return Fail({file}, "found {} beats; allowed: at least {}", beats.size(), kMinBeats);
  return beats;
}

double TempoOf(const std::vector<double>& beats_s) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < beats_s.size(); ++i) steps.push_back(beats_s[i] - beats_s[i - 1]);
  // Round the tempo to 0.01 bpm: rounded times in a file must not give a tempo just above a move's fastest tempo.
  return std::round(6000 / UpperMedian(std::move(steps))) / 100;
}

Result<Dance> ToBeats(Dance dance, const std::vector<double>& beats_s) {
  const double beats_per_s = dance.tempo_bpm / 60;
  const double last = static_cast<double>(dance.motion.poses.size() - 1) / kJudgedRateHz * beats_per_s;
  if (last > static_cast<double>(beats_s.size() - 1)) {
    return Fail({}, "found {} beats, but '{}' needs {:.0f}", beats_s.size(), dance.title, std::ceil(last) + 1);
  }
  for (MusicTag& tag : dance.tags) tag.music_s = MomentOf(tag.music_s * beats_per_s, beats_s);
  dance.beats_s = beats_s;
  return dance;
}

TaughtMove TaughtOf(const Move& move) {
  constexpr double kExtraSeconds = 0.5;  // seconds allowed beyond the duration of one performance at the taught tempo
  TaughtMove taught{.name = move.name,
                    .span_s = 60.0 * move.beats / move.tempo_bpm + kExtraSeconds,
                    .examples = {StreamOf(move.motion)}};
  for (const KeyPose& key_pose : move.key_poses) {
    TaughtPose& pose = taught.poses.emplace_back();
    for (const KeyPose::Target& target : key_pose.targets) {
      const Feature* feature = FindFeature(target.feature);
      assert(feature != nullptr);  // checked where choreography files are read
      pose.targets.push_back({*feature, target.degrees, target.tolerance_deg});
    }
  }
  return taught;
}

}  // namespace etude
