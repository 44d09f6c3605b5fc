#include "sim/choreography/move.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/base/named.h"
#include "engine/base/names.h"
#include "engine/document/fields.h"
#include "engine/fuzzy/features.h"
#include "sim/choreography/builtin_files.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/slow_demonstration.h"

namespace etude {
namespace {

/// The allowed range of a control in files: wider than the range of any body, but narrow enough to catch a typing
/// error.
constexpr Range kControlRange = {-200, 200};

/// Reads the controls of one group of a pose ("left_arm") and passes each value to `set`.
template <std::size_t kCount, typename Set>
bool ReadGroup(Fields& pose, const std::string& yaml_key, std::string_view group,
               std::span<const ControlName, kCount> names, Set set) {
  const Node* node = pose.Raw(yaml_key);
  if (node == nullptr) return false;
  std::optional<Fields> keys;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (names[i].group != group) continue;
    if (names[i].key.empty()) {
      if (auto value = pose.OptionalNumber(yaml_key, kControlRange)) set(i, *value * names[i].per_unit);
    } else {
      if (!keys) keys.emplace(*node, "'" + yaml_key + "'");
      if (auto value = keys->OptionalNumber(names[i].key, kControlRange)) set(i, *value * names[i].per_unit);
    }
  }
  if (keys) {
    if (auto ok = keys->Finish(); !ok) pose.Complain(ok.error().place, ok.error().message);
  }
  return true;
}

void ReadSide(Fields& pose, const std::string& yaml_key, std::string_view group, std::span<const Side> sides,
              Controls& controls) {
  const bool given = ReadGroup(pose, yaml_key, group, SideControlNames(), [&](std::size_t control, double value) {
    for (Side side : sides) controls.Of(side, static_cast<SideControl>(control)) = value;
  });
  if (given && (group == "leg" || group == "knee")) {
    for (Side side : sides) controls.Of(side, SideControl::kLegFree) = 1;
  }
}

Controls ReadControls(Fields& pose) {
  Controls controls = ReadyStance();
  for (std::string_view group : {"hips", "jump_cm", "trunk", "neck"}) {
    ReadGroup(pose, std::string(group), group, MiddleControlNames(),
              [&](std::size_t control, double value) { controls[static_cast<MiddleControl>(control)] = value; });
  }
  constexpr Side kBoth[] = {Side::kLeft, Side::kRight};
  const std::pair<std::string_view, std::string_view> groups[] = {
      {"arm", "arms"}, {"elbow", "elbows"}, {"wrist", "wrists"}, {"leg", "legs"}, {"knee", "knees"}, {"foot", "feet"}};
  for (const auto& [one, both] : groups) {
    ReadSide(pose, std::string(both), one, kBoth, controls);
    ReadSide(pose, "left_" + std::string(one), one, {kBoth, 1}, controls);
    ReadSide(pose, "right_" + std::string(one), one, {kBoth + 1, 1}, controls);
  }
  return controls;
}

Result<void> CheckList(const Node& list, std::string_view name) {
  constexpr std::size_t kMaxPoses = 256;
  if (list.kind != Node::Kind::kSequence || list.items.empty()) {
    return Fail(list.place, "'{}' must be a list of at least one pose, found {}", name, Describe(list));
  }
  if (list.items.size() > kMaxPoses) {
    return Fail(list.place, "found {} {}; allowed: at most {}", list.items.size(), name, kMaxPoses);
  }
  return {};
}

/// Reads the beat of a pose, which must be in [0, beats).
double ReadBeat(Fields& pose, double beats) {
  const auto beat = pose.OptionalNumber("beat", {0, beats});
  if (!beat && pose.ok()) pose.Complain(pose.node().place, "a pose needs a 'beat'");
  if (beat && *beat >= beats) {
    pose.Complain(
        pose.node().place,
        fmt::format("beat {} is at or after the end of the loop; allowed: at least 0 and below {}", *beat, beats));
  }
  return beat.value_or(0);
}

Ease ReadEase(Fields& pose) {
  constexpr std::array kEases = {std::pair("smooth", Ease::kSmooth), std::pair("linger", Ease::kLinger),
                                 std::pair("rush", Ease::kRush), std::pair("snap", Ease::kSnap)};
  std::vector<std::string> names;
  for (const auto& [name, ease] : kEases) names.emplace_back(name);
  const std::string chosen = pose.Choice("ease", names, "smooth");
  for (const auto& [name, ease] : kEases) {
    if (chosen == name) return ease;
  }
  return Ease::kSmooth;
}

KeyPose::Target ReadTarget(Fields& pose, const Node& node, std::string_view feature, double tolerance_deg) {
  constexpr Range kDegrees = {0, 180}, kTolerance = {1, 90};
  if (node.kind != Node::Kind::kMapping) {
    return {std::string(feature), pose.Number(feature, 0, kDegrees), tolerance_deg};
  }
  Fields keys(node, "a key pose's feature");
  KeyPose::Target target = {std::string(feature), keys.Number("degrees", 0, kDegrees),
                            keys.Number("tolerance_deg", tolerance_deg, kTolerance)};
  if (auto ok = keys.Finish(); !ok) pose.Complain(ok.error().place, ok.error().message);
  return target;
}

/// Reads the list `poses` of a choreography file. Each pose states, at a `beat` in [0, beats), how the body differs
/// from the ready stance (controls.h names the groups; "arms", "legs", … set both sides). `hold_beats` keeps the pose,
/// and `ease` sets the timing towards the pose. Beats must ascend. At most 256 poses are allowed.
Result<std::vector<PoseKey>> ReadPoses(const Node& poses, double beats) {
  RETURN_IF_ERROR(CheckList(poses, "poses"));
  std::vector<PoseKey> keys;
  for (const Node& item : poses.items) {
    // Read one pose.
    Fields pose(item, "a pose");
    const double beat = ReadBeat(pose, beats);
    const double hold = pose.Number("hold_beats", 0, {0, beats});
    const Ease ease = ReadEase(pose);
    const Controls controls = ReadControls(pose);
    // Check that the pose comes after the previous pose and is held within the loop.
    if (!keys.empty() && beat <= keys.back().beat) {
      pose.Complain(item.place, fmt::format("beat {} is too early, because the previous pose lasts until beat {}", beat,
                                            keys.back().beat));
    }
    if (beat + hold >= beats)
      pose.Complain(item.place, fmt::format("the pose is held until beat {} or longer; it must end earlier", beats));
    RETURN_IF_ERROR(pose.Finish());
    // Write two keys for a held pose: at the start and at the end of the hold.
    keys.push_back({beat, controls, ease});
    if (hold > 0) keys.push_back({beat + hold, controls});
  }
  return keys;
}

/// Reads the list `key_poses`, with entries of the form `{beat, tolerance_deg, <feature>: degrees, …}`. A feature may
/// have its own tolerance: `RH: {degrees: 90, tolerance_deg: 10}`.
Result<std::vector<KeyPose>> ReadKeyPoses(const Node& key_poses, double beats) {
  RETURN_IF_ERROR(CheckList(key_poses, "key_poses"));
  std::vector<KeyPose> read;
  for (const Node& item : key_poses.items) {
    Fields pose(item, "a key pose");
    KeyPose key_pose{.beat = ReadBeat(pose, beats), .targets = {}};
    const double tolerance_deg = pose.Number("tolerance_deg", 20, {1, 90});
    for (Feature feature : AllFeatures()) {
      const std::string_view name = FeatureName(feature);
      if (const Node* node = pose.Raw(name)) key_pose.targets.push_back(ReadTarget(pose, *node, name, tolerance_deg));
    }
    if (key_pose.targets.empty()) pose.Complain(item.place, "a key pose needs at least one feature, such as 'RH: 90'");
    RETURN_IF_ERROR(pose.Finish());
    read.push_back(std::move(key_pose));
  }
  return read;
}

constexpr Range kTempoRange = {40, 240};

/// Appends the second half of the move, which is the mirror image of the first half.
void AppendMirrorImage(std::vector<PoseKey>& keys, double half) {
  const std::size_t count = keys.size();
  for (std::size_t i = 0; i < count; ++i) {
    keys.push_back({keys[i].beat + half, Mirrored(keys[i].controls), keys[i].ease});
  }
}

/// Reads `tempo_range_bpm: [slowest, fastest]`, which must contain the move's own tempo.
void ReadTempoRange(Fields& fields, Move& move) {
  const std::vector<double> range = fields.Numbers("tempo_range_bpm", kTempoRange);
  move.slowest_bpm = range.empty() ? move.tempo_bpm : range.front();
  move.fastest_bpm = range.empty() ? move.tempo_bpm : range.back();
  if (range.empty()) return;
  if (range.size() != 2 || move.tempo_bpm < range[0] || move.tempo_bpm > range[1]) {
    fields.Complain(fields.Raw("tempo_range_bpm")->place,
                    fmt::format("'tempo_range_bpm' must be [slowest, fastest] and contain the tempo of the move, {}",
                                move.tempo_bpm));
  }
}

/// Computes the curves of a move from the move's poses and tempo.
Result<Move> WithCurves(Move move, MoveCurves::Style style, const Place& place) {
  style.beat_seconds = 60 / move.tempo_bpm;
  RETURN_IF_ERROR(CheckJumps(move.poses, move.beats, style.beat_seconds, place));
  move.curves = MoveCurves(move.poses, move.beats, style);
  return move;
}

Result<Move> WithMotion(Result<Move> move) {
  if (move) move->motion = MotionOf(*move);
  return move;
}

/// Reads a move or an act from a choreography file, without its motion.
Result<Move> ParseCurves(std::string_view yaml, const std::string& file) {
  ASSIGN_OR_RETURN(const auto document, ParseYaml(yaml, file));

  // Read the keys of the file's top level.
  Fields fields(document, "a choreography file");
  const bool is_act = document.Find("act") != nullptr;
  Move move;
  move.name = fields.RequiredText(is_act ? "act" : "move");
  move.tempo_bpm = fields.Number("tempo_bpm", 120, kTempoRange);
  ReadTempoRange(fields, move);
  move.beats = fields.Number("beats", 8, {1, 64});
  const bool mirrored = fields.Boolean("second_half_mirrored", false);
  if (is_act) move.loops = fields.Boolean("loops", true);
  const MoveCurves::Style style = {.overlap_beats = fields.Number("overlap_beats", 0.1, {0, 0.5}),
                                   .bounce = 0.01 * fields.Number("bounce_cm", 0, {0, 20}),
                                   .loops = move.loops};
  // Errors about a missing list name the place of `document`, because the list itself has no place.
  Node missing;
  missing.place = document.place;
  const Node* poses = fields.Raw("poses");
  // Acts have no key poses, because acts are never judged.
  const Node* key_poses = is_act ? nullptr : fields.Raw("key_poses");
  RETURN_IF_ERROR(fields.Finish());

  // Read the poses, mirror them if the file demands it, and read the key poses.
  const double authored_beats = mirrored ? 0.5 * move.beats : move.beats;
  ASSIGN_OR_RETURN(auto keys, ReadPoses(poses ? *poses : missing, authored_beats));
  if (mirrored) AppendMirrorImage(keys, authored_beats);
  if (!is_act) {
    ASSIGN_OR_RETURN(auto targets, ReadKeyPoses(key_poses ? *key_poses : missing, move.beats));
    move.key_poses = std::move(targets);
  }
  move.poses = std::move(keys);
  return WithCurves(std::move(move), style, document.place);
}

}  // namespace

Result<Move> ParseMove(std::string_view yaml, const std::string& file) { return WithMotion(ParseCurves(yaml, file)); }

Result<Move> CurvesAtTempo(const Move& move, double tempo_bpm, const Place& place) {
  Move other = move;
  other.tempo_bpm = tempo_bpm;
  return WithCurves(std::move(other), move.curves.style(), place);
}

Result<Move> AtTempo(const Move& move, double tempo_bpm, const Place& place) {
  return WithMotion(CurvesAtTempo(move, tempo_bpm, place));
}

BodyMotion MotionOf(const Move& move) {
  const double seconds = move.beats * 60.0 / move.tempo_bpm;
  const auto steps = static_cast<int>(std::lround(seconds * kJudgedRateHz));
  // After the last frame of a loop comes its first frame; other motions include their last pose.
  const int frames = move.loops ? steps : steps + 1;
  BodyMotion motion;
  motion.poses.reserve(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) motion.poses.push_back(PoseOf(move.curves.At(move.beats * i / steps)));
  return motion;
}

std::vector<std::string> BuiltinMoveNames() { return NamesOf(BuiltinMoveFiles(), StemOf); }
std::vector<std::string> BuiltinActNames() { return NamesOf(BuiltinActFiles(), StemOf); }

Result<Move> LoadBuiltinMove(const std::string& name) {
  const bool is_slow = name.starts_with(kSlowDemonstrationPrefix);
  const std::string authored = name.substr(is_slow ? kSlowDemonstrationPrefix.size() : 0);
  if (!is_slow || FindByName(BuiltinMoveFiles(), authored, StemOf) == nullptr) return WithMotion(LoadBuiltinCurves(name));
  const Result<Move> move = WithMotion(LoadBuiltinCurves(authored));
  return move ? SlowDemonstration(*move) : move;
}

Result<Move> LoadBuiltinCurves(const std::string& name) {
  if (const EmbeddedText* file = FindByName(BuiltinMoveFiles(), name, StemOf)) {
    return ParseCurves(file->text, "scenarios/choreography/moves/" + std::string(file->name));
  }
  if (const EmbeddedText* file = FindByName(BuiltinActFiles(), name, StemOf)) {
    return ParseCurves(file->text, "scenarios/choreography/acts/" + std::string(file->name));
  }
  std::vector<std::string> known = BuiltinMoveNames();
  std::ranges::copy(BuiltinActNames(), std::back_inserter(known));
  return Fail({}, "{}", UnknownName("move", name, known));
}

}  // namespace etude
