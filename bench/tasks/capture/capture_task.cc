#include "bench/tasks/capture/capture_task.h"

#include <algorithm>

#include "bench/tasks/capture/capture_cell.h"
#include "bench/tasks/capture/capture_options.h"
#include "bench/tasks/capture/capture_world.h"
#include "bench/tasks/capture/film.h"

namespace etude {
namespace {

class CaptureTask : public Task {
 public:
  CaptureTask(StudioOptions options, std::vector<CaptureMethod> methods, ClipLibrary clips, bool wants_recordings)
      : options_(std::move(options)),
        methods_(std::move(methods)),
        clips_(std::move(clips)),
        wants_recordings_(wants_recordings) {}

  std::vector<CellResult> RunWorld(const WorldKey& key) const override {
    auto renderer = Renderer::Create();
    if (!renderer) {
      return std::vector<CellResult>(methods_.size(), CellResult::Ended(Status::kFailed, renderer.error().message));
    }
    const CaptureWorld world = MakeCaptureWorld(options_, ClipFor(key), key);
    // Methods that cut out the person alike see the very same marks.
    std::vector<PersonSource> sources;
    for (const CaptureMethod& method : methods_) {
      const PersonSource source = PersonSourceOf(method);
      if (std::find(sources.begin(), sources.end(), source) == sources.end()) sources.push_back(source);
    }
    const Take take = Film(world, options_, key, sources, wants_recordings_, **renderer);
    std::vector<CellResult> cells;
    for (const CaptureMethod& method : methods_) {
      const auto source = std::find(sources.begin(), sources.end(), PersonSourceOf(method));
      const Observation& observation = take.observations[static_cast<std::size_t>(source - sources.begin())];
      cells.push_back(RunCaptureCell(world, take, observation, options_, method, wants_recordings_));
    }
    return cells;
  }

  std::string ClipOf(const WorldKey& key) const override { return ClipFor(key).name; }

 private:
  const LibraryClip& ClipFor(const WorldKey& key) const {
    return clips_.clips[static_cast<std::size_t>(key.trial) % clips_.clips.size()];
  }

  const StudioOptions options_;
  const std::vector<CaptureMethod> methods_;
  const ClipLibrary clips_;
  const bool wants_recordings_;
};

Result<std::unique_ptr<Task>> MakeCaptureTask(TaskInput& input) {
  StudioOptions options = ReadStudioOptions(input.condition);
  auto methods = ReadCaptureMethods(input.methods);
  if (!methods) return tl::unexpected(methods.error());
  if (input.clips.clips.empty()) {
    return Fail(input.condition.node().place, "a capture scenario needs clips, e.g. clips: ['builtin:boxing']");
  }
  return std::make_unique<CaptureTask>(std::move(options), *std::move(methods), input.clips, input.wants_recordings);
}

}  // namespace

TaskKind MakeCaptureTaskKind() {
  return {"capture",
          "How close does the skeleton that two cameras see come to the true one?",
          {"mpjpe_mm", "mpjpe_before_ik_mm", "pa_mpjpe_mm", "pck_50mm", "position_error_cm", "frames_recovered"},
          MakeCaptureTask,
          CaptureMethodKeys()};
}

}  // namespace etude
