#include "sim/choreography/move.h"

#include <algorithm>
#include <cmath>

#include "engine/base/names.h"
#include "engine/document/fields.h"
#include "sim/choreography/builtin_files.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/pose_reader.h"

namespace etude {
namespace {

std::string_view NameOf(const EmbeddedText& file) { return file.name.substr(0, file.name.rfind('.')); }

/// Appends the first half's mirror image as the second half.
void AppendMirrorImage(std::vector<PoseKey>& keys, double half) {
  const std::size_t count = keys.size();
  for (std::size_t i = 0; i < count; ++i) keys.push_back({keys[i].beat + half, Mirrored(keys[i].controls)});
}

/// One performance, sampled so that the frame after the last one is the first: the loop has no seam.
BodyMotion Sample(const MoveCurves& curves, double beats, double tempo_bpm) {
  const double seconds = beats * 60.0 / tempo_bpm;
  const auto frames = static_cast<int>(std::lround(seconds * kJudgedRateHz));
  BodyMotion motion;
  for (int i = 0; i < frames; ++i) motion.poses.push_back(PoseOf(curves.At(beats * i / frames)));
  return motion;
}

}  // namespace

Result<Move> ParseMove(std::string_view yaml, const std::string& file) {
  const auto document = ParseYaml(yaml, file);
  if (!document) return tl::unexpected(document.error());

  Fields fields(*document, "a choreography file");
  Move move;
  move.name = fields.RequiredText("move");
  move.tempo_bpm = fields.Number("tempo_bpm", 120, {40, 240});
  move.beats = fields.Number("beats", 8, {1, 64});
  const bool mirrored = fields.Boolean("second_half_mirrored", false);
  const MoveCurves::Style style = {.overlap_beats = fields.Number("overlap_beats", 0.1, {0, 0.5}),
                                   .bounce = 0.01 * fields.Number("bounce_cm", 0, {0, 20})};
  Node nothing;
  nothing.place = document->place;
  const Node* poses = fields.Raw("poses");
  const Node* key_poses = fields.Raw("key_poses");
  if (auto ok = fields.Finish(); !ok) return tl::unexpected(ok.error());

  const double authored_beats = mirrored ? 0.5 * move.beats : move.beats;
  auto keys = ReadPoses(poses ? *poses : nothing, authored_beats);
  if (!keys) return tl::unexpected(keys.error());
  if (mirrored) AppendMirrorImage(*keys, authored_beats);
  auto targets = ReadKeyPoses(key_poses ? *key_poses : nothing, move.beats);
  if (!targets) return tl::unexpected(targets.error());

  move.key_poses = std::move(*targets);
  move.curves = MoveCurves(*keys, move.beats, style);
  move.motion = Sample(move.curves, move.beats, move.tempo_bpm);
  return move;
}

std::vector<std::string> BuiltinMoveNames() {
  std::vector<std::string> names;
  for (const EmbeddedText& file : BuiltinMoveFiles()) names.emplace_back(NameOf(file));
  return names;
}

Result<Move> LoadBuiltinMove(const std::string& name) {
  const auto files = BuiltinMoveFiles();
  const auto file = std::ranges::find(files, name, NameOf);
  if (file == files.end()) return Fail({}, "{}", UnknownName("move", name, BuiltinMoveNames()));
  return ParseMove(file->text, "scenarios/choreography/moves/" + std::string(file->name));
}

}  // namespace etude
