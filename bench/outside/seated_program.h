#pragma once

#include <optional>
#include <string>

#include "bench/outside/outside_method.h"
#include "bench/tasks/base/task.h"
#include "engine/base/digest.h"

namespace etude {

/// An outside program that takes a seat: it replaces one part of the loop that a task simulates (TaskKind::seats),
/// and is asked for an answer at every step. After its first failure, the program is not asked again.
class SeatedProgram : public LiveProgram {
 public:
  /// `id` names the program's sessions. `method` and `setting` must outlive this object.
  SeatedProgram(OutsideMethod& method, std::string setting_id, const Payload& setting, std::string id);

  bool Begin(const Payload& session) override;
  JsonPtr Step(const Payload& step) override;
  /// Ends the last session. A program that wrote more than its answers has then failed.
  void End();

  /// Returns the program's first failure; nullopt if it has not failed.
  const std::optional<CellResult>& failure() const { return failure_; }
  /// Returns false if the program could not be asked because of this machine.
  bool was_asked() const { return was_asked_; }
  double cpu_s() const { return cpu_s_; }
  double peak_mb() const { return peak_mb_; }
  int repeated() const { return repeated_; }
  std::string AnswersDigest() const { return answers_.Hex(); }

 private:
  OutsideReply Note(OutsideReply reply);

  OutsideMethod& method_;
  const std::string setting_id_;
  const Payload& setting_;
  const std::string id_;
  int sessions_ = 0;
  std::optional<CellResult> failure_;
  bool was_asked_ = true;
  double cpu_s_ = 0, peak_mb_ = 0;
  int repeated_ = 0;
  Digest answers_;
};

}  // namespace etude
