#pragma once

#include <map>
#include <memory>
#include <string>

#include "bench/model/row.h"
#include "bench/outside/outside_method.h"
#include "bench/run/outside_metrics.h"
#include "bench/run/setup.h"
#include "io/process/clock.h"

namespace etude {

struct FinishedCell {
  Row row;
  CellUsage usage;
  /// False: the method has answered, and metrics of other programs have yet to measure what it did
  /// (CellRunner::Measure).
  bool is_measured = true;
  /// The reason why this machine kept the method from being asked; "" = it was asked. A cell with a reason has no row.
  std::string why_not_run = {};
};

/// Scores an answer that did not come from a built-in method; its fingerprint stands among the digests of the cell.
/// Fails as TaskWorld::Judge.
Result<CellResult> JudgeAnswer(TaskWorld& world, const Json& answer);

/// Runs the cells of one world after the other, as a worker does: the world is built once, methods outside
/// stay alive from world to world.
class CellRunner {
 public:
  /// Standard error of methods outside goes to files in `error_folder`; "" = to our own. They run in `fence`.
  CellRunner(const PreparedScenario& scenario, std::string error_folder, const Fence& fence);
  ~CellRunner();

  /// Builds the world. Whatever goes wrong in it is told by every cell.
  void Open(int condition, int trial);
  /// Runs a method in the open world. A task that throws gives a failed row. Where memory ends, the cell is
  /// `out_of_memory` if it held more than the scenario allows; else the machine lacks it, and the cell is not run. A
  /// cell that left a motion is not measured by other programs yet: they would know the truth of a world in which
  /// methods are still to be asked.
  FinishedCell Run(std::size_t method);
  /// Asks the programs that measure an answered cell. A run does so when all methods have answered (RunOrders).
  FinishedCell Measure(int condition, FinishedCell answered);

 private:
  /// The high-water mark of this process's memory. To ask the kernel takes as long as a short cell.
  class PeakMemory {
   public:
    void Begin();
    double Mb();

   private:
    static constexpr std::chrono::milliseconds kLookEvery{5};
    Clock::time_point looked_ = {};
    double mb_ = 0;
  };

  /// The result of a cell in which something was thrown; or `why_not_run_`.
  CellResult Thrown(const std::string& when, const std::exception& error);
  /// Drops the motion of a measured cell that is not recorded, and names the metrics that it does not report.
  void Complete(int condition, Row& row) const;
  CellResult RunMethod(std::size_t method, CellUsage& usage);
  CellResult AskOutside(std::size_t method, CellUsage& usage);
  CellResult RunWithProgram(std::size_t method, CellUsage& usage);
  /// Its place among those that the task runs.
  std::size_t IndexInTask(std::size_t method) const;
  /// The message to methods outside before their first problem; a cell that ended when it cannot be made.
  tl::expected<const Payload*, CellResult> OpenSetting();
  std::string SettingId() const;

  const PreparedScenario& scenario_;
  const std::string error_folder_;
  std::map<std::size_t, OutsideMethod> outside_;  ///< by method
  OutsideMetrics metrics_;
  int condition_ = 0, trial_ = 0;
  std::unique_ptr<TaskWorld> world_;
  CellResult why_no_world_;
  std::string why_not_run_;        ///< the cell that is being run
  std::string why_world_not_run_;  ///< the cells of a world that could not be built
  CellUsage world_usage_;
  PeakMemory peak_memory_;
  std::unique_ptr<Payload> setting_, problem_;  ///< of the open world, once asked for
  int condition_of_setting_ = -1;
};

}  // namespace etude
