#include "bench/tasks/inbetween/windows.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "bench/tasks/evaluation/find_files.h"
#include "engine/base/text.h"
#include "io/clips/open_clip.h"
#include "io/clips/raw_motions.h"
#include "io/clips/references.h"

namespace etude {
namespace {

constexpr char kBeforeFirst = '@';

/// Returns the rate of a file, Hz. A file may round its time per frame (0.0083333 s for 120 Hz). If the rate differs
/// from a multiple of the protocol's rate only by rounding, returns that multiple, so that no frame is interpolated.
double OwnRate(double rate_hz, const InbetweenOptions& options) {
  constexpr double kFewDigits = 1e-4;
  const double wanted = options.rate_hz.value_or(rate_hz), whole = wanted * std::round(rate_hz / wanted);
  return std::abs(rate_hz - whole) < kFewDigits * rate_hz ? whole : rate_hz;
}

/// Returns the number of frames of a motion after it is sampled at the protocol's rate. `frames` is the number before.
std::size_t SampledFrames(std::size_t frames, double own_rate_hz, const InbetweenOptions& options) {
  if (!options.rate_hz || frames == 0) return frames;
  constexpr double kRounding = 1e-6;  // tolerance in frames, as in `Sampled`
  const double last = static_cast<double>(frames - 1) * *options.rate_hz / OwnRate(own_rate_hz, options);
  return static_cast<std::size_t>(last + kRounding) + 1;
}

/// Calls `visit` with the first frame of each window. The windows are those of LAFAN1's code.
template <typename Visit>
void ForEachWindow(std::size_t frames, int window, int offset, const Visit& visit) {
  for (std::size_t first = 0; first + static_cast<std::size_t>(window) < frames;
       first += static_cast<std::size_t>(offset)) {
    visit(static_cast<int>(first));
  }
}

/// Returns a text that two references share if they name the same motion, even by different paths or in copies of a
/// file.
std::string IdentityOf(const std::string& reference) {
  const SplitReference split = Split(reference);
  const std::string animation = '#' + split.animation.value_or("");
  // Motions of .gltf and .amc files need a second file, so such files with the same bytes may hold different motions.
  const std::string ending = InLowerCase(std::filesystem::path(split.path).extension().string());
  const auto digest = DigestOfFile(reference, {});
  if (digest && ending != ".gltf" && ending != ".amc") return *digest + animation;
  std::error_code none;
  const auto path = std::filesystem::canonical(FileOf(split.path), none);
  return (none ? split.path : path.string()) + animation;
}

}  // namespace

int FirstFrameOf(const std::string& window) {
  int first = 0;
  const std::size_t at = window.rfind(kBeforeFirst) + 1;
  std::from_chars(window.data() + at, window.data() + window.size(), first);
  return first;
}

Result<FoundFiles> FindWindows(const Node& condition, std::span<const Node> methods,
                               const std::map<std::string, std::string>& /*texts*/) {
  // Read this task's keys. Unknown keys are reported later, when the task is made.
  InbetweenOptions options;
  Fields fields(condition, "a scenario of task inbetween");
  InbetweenConditionFields().Read(fields, options);
  if (!fields.ok()) return tl::unexpected(fields.Finish().error());
  if (const Node* trials = condition.Find("trials")) {
    return Fail(trials->place, "'trials' is not allowed in task inbetween, because each window is judged once");
  }
  for (const char* key : {"truth", "training"}) {
    if (condition.Find(key) == nullptr) return Fail(condition.place, "task inbetween needs '{}'", key);
  }
  const Place &place = condition.Find("truth")->place, &training_place = condition.Find("training")->place;
  FoundFiles found;
  ASSIGN_OR_RETURN(const auto files, ExpandFiles(options.truth, Links::kAllowed, place, found.left_out));
  ASSIGN_OR_RETURN(const auto training, ExpandFiles(options.training, Links::kAllowed, training_place, found.left_out));
  // List the windows.
  std::map<std::string, std::string> named, trained, judged;
  for (const std::string& file : training) trained.emplace(IdentityOf(file), file);
  for (const std::string& file : files) {
    const std::string name = NameOfReference(file);
    const auto [known, is_new] = named.emplace(name, file);
    if (!is_new)
      return Fail(place, "'{}' and '{}' have the same name; the files of 'truth' need different names", known->second,
                  file);
    const std::string identity = IdentityOf(file);
    if (const auto other = trained.find(identity); other != trained.end()) {
      return Fail(training_place, "'{}' is in 'truth' and in 'training'{}; allowed: only in one of the two lists",
                  other->second, other->second == file ? "" : " (in 'truth' as '" + file + "')");
    }
    if (const auto [first, is_first] = judged.emplace(identity, file); !is_first)
      return Fail(place, "'{}' and '{}' are the same motion; 'truth' needs different motions", first->second, file);
    const auto clip = ReadOneClip(file, {});
    if (!clip) {
      found.left_out.emplace_back(file, ToString(clip.error()));
      continue;
    }
    const std::size_t before = found.worlds.size();
    const std::size_t frames = SampledFrames(clip->clip.frames.size(), clip->clip.rate_hz, options);
    ForEachWindow(frames, options.window, options.offset, [&](int first) {
      found.worlds.push_back({.name = fmt::format("{}{}{}", name, kBeforeFirst, first),
                              .unit = name,
                              .truth = file,
                              .answers = std::vector<std::string>(methods.size())});
    });
    if (found.worlds.size() > kMaxPairs) return Fail(place, "more than {} windows", kMaxPairs);
    if (found.worlds.size() > before) continue;
    found.left_out.emplace_back(file, fmt::format("{} frames; a window of {} frames needs at least {}", frames,
                                                  options.window, options.window + 1));
  }
  if (found.worlds.empty()) {
    return Fail(place, "no file has a window of {} frames: {}", options.window, found.left_out.back().second);
  }
  if (!options.people.empty()) {
    // FindPeople's pattern is for the file's name. In the names of windows, '@' and the first frame follow the file's
    // name.
    RETURN_IF_ERROR(FindPeople(options.people + kBeforeFirst + '*', condition.Find("people")->place, found.worlds));
  }
  return found;
}

Result<HiddenWindow> OpenJudged(const std::string& reference, const InbetweenOptions& options,
                                const OpenOptions& opening) {
  ASSIGN_OR_RETURN(auto clip, ReadOneClip(reference, opening));
  const bool is_body = clip.format == ClipFormat::kBuiltin || clip.made.has_value();
  ASSIGN_OR_RETURN(auto raw, RawMotionOf(std::move(clip), opening, reference.starts_with(kBuiltinPrefix)));
  // Put the hip centre midway between the hips, where it already is in the motion of a body.
  if (!is_body && HasOwnRoot(raw)) AddMidwayHips(raw);
  if (options.rate_hz) {
    raw.rate_hz = OwnRate(raw.rate_hz, options);
    raw = Sampled(raw, *options.rate_hz, 0, SampledFrames(raw.FrameCount(), raw.rate_hz, options));
  }
  HiddenWindow whole;
  ASSIGN_OR_RETURN(whole.motion, TreeMotionOf(raw));
  whole.roles = raw.roles;
  return whole;
}

std::vector<TreePose> PlacedWindow(std::span<const TreePose> poses, int first, int count, int past,
                                   const glm::dvec3& facing) {
  const auto begin = poses.begin() + first;
  std::vector<TreePose> window(begin, begin + count);
  // Move the root so that its mean position is above the origin.
  glm::dvec3 mean(0);
  for (const TreePose& pose : window) mean += pose.root / static_cast<double>(count);
  mean.y = 0;
  // Turn the motion about the vertical axis, so that the root's axis `facing` points along X.
  const glm::dvec3 axis = window[static_cast<std::size_t>(past - 1)].turns[0] * facing;
  const glm::dquat turn = glm::angleAxis(std::atan2(axis.z, axis.x), glm::dvec3(0, 1, 0));
  for (TreePose& pose : window) {
    pose.root = turn * (pose.root - mean);
    pose.turns[0] = turn * pose.turns[0];
  }
  return window;
}

Result<std::vector<TrainingTree>> Train(const InbetweenOptions& options, const OpenOptions& opening,
                                        GapLibrary* library) {
  std::vector<LeftOutFile> reported;  // FindWindows has reported the files that were left out
  ASSIGN_OR_RETURN(const auto files, ExpandFiles(options.training, Links::kAllowed, {}, reported));
  constexpr std::size_t kMaxLibraryFrames = 200'000;  // about half a gigabyte
  std::vector<TrainingTree> trees;
  std::size_t frames = 0;
  std::vector<glm::dvec3> positions;
  std::vector<glm::dquat> turns;
  for (const std::string& file : files) {
    ASSIGN_OR_RETURN(auto judged, OpenJudged(file, options, opening));
    // Find the statistics of this joint tree, or begin new ones.
    TreeMotion& motion = judged.motion;
    auto known = std::ranges::find_if(trees, [&](const TrainingTree& one) { return one.tree.IsLike(motion.tree); });
    if (known == trees.end()) {
      const std::vector<glm::dvec3> zeros(motion.tree.size());
      known = trees.insert(trees.end(), TrainingTree{motion.tree, zeros, zeros, 0});
    }
    // Add up the positions over all training windows.
    ForEachWindow(motion.poses.size(), options.training_window, options.training_offset, [&](int first) {
      for (const TreePose& pose :
           PlacedWindow(motion.poses, first, options.training_window, options.past, options.facing)) {
        positions.clear();
        turns.clear();
        AppendGlobals(motion.tree, pose, positions, turns);
        for (std::size_t j = 0; j < positions.size(); ++j) {
          known->sums[j] += positions[j];
          known->squares[j] += positions[j] * positions[j];
        }
        known->count += 1;
      }
    });
    if (library == nullptr) continue;
    frames += motion.poses.size();
    if (frames > kMaxLibraryFrames) {
      return Fail({file}, "the training clips have more than {} frames, too many for a filler's library",
                  kMaxLibraryFrames);
    }
    library->Add(std::move(motion));
  }
  return trees;
}

std::vector<glm::dvec3> TrainingTree::Deviations() const {
  std::vector<glm::dvec3> deviations;
  for (std::size_t j = 0; j < tree.size() && count > 0; ++j) {
    const glm::dvec3 mean = sums[j] / count;
    deviations.push_back(glm::sqrt(glm::max(squares[j] / count - mean * mean, glm::dvec3(0))));
  }
  return deviations;
}

}  // namespace etude
