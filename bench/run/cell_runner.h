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
  /// False if the method has answered, but outside metric programs must still measure the answer (CellRunner::Measure).
  bool is_measured = true;
  /// The reason why this machine could not run the method; such a cell gets no row. "" if the method ran.
  std::string why_not_run = {};
};

/// Scores an outside method's answer, and adds the answer's digest to the digests of the result. Fails if
/// TaskWorld::Judge fails.
Result<CellResult> JudgeAnswer(TaskWorld& world, const Json& answer);

/// Runs cells, world by world. Each world is built once. Outside methods keep running between worlds.
class CellRunner {
 public:
  /// Outside methods run in the sandbox `fence`. Their standard error goes to files in `error_folder`, or to Etude's
  /// standard error if `error_folder` is "".
  CellRunner(const PreparedScenario& scenario, std::string error_folder, const Fence& fence);
  ~CellRunner();

  /// Builds the world of a trial under a condition. If the world cannot be built, all its cells end with the same
  /// failure.
  void Open(int condition, int trial);
  /// Runs a method in the open world. If the method throws an exception, the cell's status is `failed`, unless memory
  /// ran out: if this process then held more memory than the scenario allows, the status is `out_of_memory`; if it
  /// held less, the machine has too little memory, and the cell counts as not run. Outside metric programs measure
  /// the cell later, in Measure, because they receive the truth of the world, which no outside method may learn
  /// before it has answered.
  FinishedCell Run(std::size_t method);
  /// Lets the outside metric programs measure an answered cell. A run calls this function after all methods have
  /// answered (RunOrders).
  FinishedCell Measure(int condition, FinishedCell answered);

 private:
  /// Measures the peak resident size of this process. Reading the size takes as long as running a short cell, so the
  /// value is cached for 5 ms.
  class PeakMemory {
   public:
    void Begin();
    double Mb();

   private:
    static constexpr std::chrono::milliseconds kLookEvery{5};
    Clock::time_point looked_ = {};
    double mb_ = 0;
  };

  /// Returns the result of a cell that ended with an exception. If this machine caused the exception, sets
  /// `why_not_run_`.
  CellResult Thrown(const std::string& when, const std::exception& error);
  /// Removes the recording of a measured cell unless the scenario keeps it, and adds the metrics that the row lacks
  /// (PreparedScenario::CompleteMetrics).
  void Complete(int condition, Row& row) const;
  CellResult RunMethod(std::size_t method, CellUsage& usage);
  CellResult AskOutside(std::size_t method, CellUsage& usage);
  /// Returns a text with the name of an outside method and the reason why the method did not get the problem.
  std::string WhyNotAsked(std::size_t method, const std::string& reason) const;
  CellResult RunWithProgram(std::size_t method, CellUsage& usage);
  std::size_t IndexInTask(std::size_t method) const;
  /// Returns the setting of the open world: the data that all problems of its condition share (Task::Setting) or, if
  /// each world has a setting of its own (Task::HasOwnSettings), the data of this world alone. If the setting cannot
  /// be made, returns the failure as the result of the cell.
  tl::expected<const Payload*, CellResult> OpenSetting();
  std::string SettingId() const;

  const PreparedScenario& scenario_;
  const std::string error_folder_;
  std::map<std::size_t, OutsideMethod> outside_;  ///< the running outside methods, by index of the method
  OutsideMetrics metrics_;
  int condition_ = 0, trial_ = 0;
  std::unique_ptr<TaskWorld> world_;
  CellResult why_no_world_;
  std::string why_not_run_;  ///< why this machine could not run the current cell; "" if it could
  /// The reason why this machine could not build the world, so that no cell could be run; "" if it could.
  std::string why_world_not_run_;
  CellUsage world_usage_;
  PeakMemory peak_memory_;
  /// Data for outside methods; null until an outside method needs them. `setting_` belongs to `condition_of_setting_`
  /// and, if each world has a setting of its own, to `trial_of_setting_`; `problem_` belongs to the open world.
  std::unique_ptr<Payload> setting_, problem_;
  int condition_of_setting_ = -1, trial_of_setting_ = -1;
};

}  // namespace etude
