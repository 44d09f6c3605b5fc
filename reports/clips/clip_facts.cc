#include "reports/clips/clip_facts.h"

#include <fmt/format.h>

#include <algorithm>

namespace etude {
namespace {

/// "Fur", or "Fur (texture of 1024 x 1024)".
std::string NameOf(const Material& material) {
  if (!material.texture) return material.name;
  const ColourImage& picture = material.texture->picture;
  return fmt::format("{} (texture of {} x {})", material.name, picture.width, picture.height);
}

FigureFacts FactsOfFigure(const Character& figure) {
  FigureFacts facts;
  facts.meshes = figure.meshes.size();
  if (figure.meshes.empty()) return facts;
  for (const SkinnedMesh& mesh : figure.meshes) facts.triangles += mesh.triangles.size();
  for (const Material& material : figure.materials) facts.materials.push_back(NameOf(material));
  return facts;
}

void CountJoints(const Skeleton& skeleton, ClipFacts& facts) {
  facts.end_sites = static_cast<std::size_t>(std::ranges::count_if(skeleton.joints, &Joint::is_end_site));
  facts.joints = skeleton.joints.size() - facts.end_sites;
}

ClipFacts FactsOfSource(const SourceClip& source) {
  ClipFacts facts;
  facts.name = source.name;
  facts.source = source.source;
  facts.format = source.format;
  facts.frames = source.clip.frames.size();
  facts.rate_hz = source.clip.rate_hz;
  facts.duration_s = source.clip.DurationSeconds();
  CountJoints(source.clip.skeleton, facts);
  if (source.character) facts.figure = FactsOfFigure(*source.character);
  return facts;
}

BodyFacts FactsOfBody(const OpenedClip& clip) {
  const BodyConversion& body = clip.body;
  BodyFacts facts{.joints = {},
                  .composed = clip.map.composed,
                  .unit = body.unit,
                  .metres_per_unit = body.metres_per_unit,
                  .up = body.up,
                  .floor = body.floor,
                  .dropped_t_pose = body.dropped_frames > 0,
                  .note = body.note,
                  .motion = ComputeStatistics(body.motion)};
  for (const Role role : AllRoles()) {
    facts.joints[Index(role)] = clip.source.clip.skeleton.joints[clip.map[role].joint].name;
  }
  return facts;
}

/// A file that gives no clip: what can be said of it all the same.
ClipFacts FactsWithoutClip(const std::string& reference, Error complaint) {
  ClipFacts facts;
  facts.name = facts.source = reference;
  facts.complaint = std::move(complaint);
  const auto file = ReadClipFile(reference);
  if (!file) return facts;
  facts.format = file->format;
  CountJoints(file->figure.skeleton, facts);
  facts.figure = FactsOfFigure(file->figure);
  return facts;
}

}  // namespace

std::vector<ClipFacts> FactsOf(const std::string& reference, const OpenOptions& options) {
  auto clips = ReadClips(reference, options);
  if (!clips) return {FactsWithoutClip(reference, clips.error())};
  std::vector<ClipFacts> all;
  for (SourceClip& clip : *clips) {
    ClipFacts facts = FactsOfSource(clip);
    const auto opened = UnderstandClip(std::move(clip), options);
    if (opened) {
      facts.body = FactsOfBody(*opened);
    } else {
      facts.complaint = opened.error();
    }
    all.push_back(std::move(facts));
  }
  return all;
}

ClipFacts FactsOf(const OpenedClip& clip) {
  ClipFacts facts = FactsOfSource(clip.source);
  facts.body = FactsOfBody(clip);
  return facts;
}

}  // namespace etude
