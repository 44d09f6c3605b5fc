#include "bench/tasks/ik/ik_task.h"

#include "bench/tasks/ik/ik_cell.h"
#include "bench/tasks/ik/ik_options.h"
#include "bench/tasks/ik/ik_world.h"

namespace etude {
namespace {

class IkTask : public Task {
 public:
  IkTask(const IkTrialOptions& trial, std::vector<IkMethod> methods, bool wants_recordings)
      : trial_(trial), methods_(std::move(methods)), wants_recordings_(wants_recordings) {}

  std::vector<CellResult> RunWorld(const WorldKey& key) const override {
    const IkWorld world = MakeIkWorld(tree_, trial_, key);
    std::vector<CellResult> cells;
    for (const IkMethod& method : methods_) cells.push_back(RunIkCell(tree_, world, method, wants_recordings_));
    return cells;
  }

  std::string ClipOf(const WorldKey&) const override { return ""; }

 private:
  const KinematicTree tree_ = MakeBodyTree({});
  const IkTrialOptions trial_;
  const std::vector<IkMethod> methods_;
  const bool wants_recordings_;
};

Result<std::unique_ptr<Task>> MakeIkTask(TaskInput& input) {
  const IkTrialOptions trial = ReadIkTrialOptions(input.condition);
  auto methods = ReadIkMethods(input.condition, input.methods, trial);
  if (!input.condition.ok()) return tl::unexpected(input.condition.Finish().error());
  if (!methods) return tl::unexpected(methods.error());
  return std::make_unique<IkTask>(trial, *std::move(methods), input.wants_recordings);
}

}  // namespace

TaskKind MakeIkTaskKind() {
  return {"ik",
          "How near do the end effectors come to their targets, and how far do the hidden angles stray?",
          {"orientation_error_deg", "position_error_cm", "hidden_angle_error_deg", "solved_practical", "iterations"},
          MakeIkTask,
          IkMethodKeys()};
}

}  // namespace etude
