#include "sim/choreography/dance_of.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/named.h"
#include "engine/base/names.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/slow_demonstration.h"

namespace etude {
namespace {

/// Up to so many degrees (Posture: on its scale) a feature is called so.
struct Word {
  double up_to;
  std::string_view word;
};
constexpr double kAny = 1e9;

/// What a feature is about, without its side, and its words; "" = not worth saying.
struct Vocabulary {
  std::string_view feature;  ///< R or L left out
  std::string_view part;     ///< of the body
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

/// The two sides of one part; "both …s" when they are alike.
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

/// The pose with its targets' sides exchanged.
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

/// The moment of every beat, from the song's beginning to its end.
std::vector<double> BeatsOf(const Song& song) {
  std::vector<double> beats;
  for (int beat = 0; beat * 60 / song.tempo_bpm <= song.motion.DurationSeconds(); ++beat) {
    beats.push_back(beat * 60 / song.tempo_bpm);
  }
  return beats;
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
  std::vector<int> moves;  // of each repetition
  for (const SongPart& part : song.parts) {
    if (!indices.contains(part.move)) {
      indices[part.move] = static_cast<int>(dance.moves.size());
      ASSIGN_OR_RETURN(auto move, DanceMoveOf(part.move));
      dance.moves.push_back(std::move(move));
    }
    moves.insert(moves.end(), part.times, indices[part.move]);
  }
  // A song has a tag at the beginning of every repetition.
  const SongPart& last = song.parts.back();
  const double end_s = (last.start_beat + last.beats) * 60 / song.tempo_bpm;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const auto end = i + 1 < moves.size() ? song.tags[i + 1].frame : static_cast<std::size_t>(end_s * kJudgedRateHz);
    dance.repetitions.push_back({.move = moves[i], .first = song.tags[i].frame, .end = end});
  }
  for (const std::string& name : BuiltinActNames()) {
    ASSIGN_OR_RETURN(auto act, LoadBuiltinMove(name));
    dance.acts.push_back({.name = name, .motion = std::move(act.motion), .loops = act.loops});
  }
  return dance;
}

TaughtMove TaughtOf(const Move& move) {
  constexpr double kForTheSlow = 0.5;  // seconds beyond one performance at the taught tempo
  TaughtMove taught{.name = move.name,
                    .span_s = 60.0 * move.beats / move.tempo_bpm + kForTheSlow,
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
