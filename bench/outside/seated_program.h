#pragma once

#include <optional>
#include <string>

#include "bench/outside/outside_method.h"
#include "bench/tasks/base/task.h"
#include "engine/base/digest.h"

namespace etude {

/// A method outside in a seat of a world's loop. Once it has failed it is asked no more.
class SeatedProgram : public LiveProgram {
 public:
  /// Makes one whose sessions are named by `id`. `method` and `setting` must outlive it.
  SeatedProgram(OutsideMethod& method, std::string setting_id, const Payload& setting, std::string id);

  bool Begin(const Payload& session) override;
  JsonPtr Step(const Payload& step) override;

  /// Tells how it failed, if it has.
  const std::optional<CellResult>& failure() const { return failure_; }
  /// False when it has failed since this machine kept us from asking it.
  bool was_asked() const { return was_asked_; }
  double cpu_s() const { return cpu_s_; }
  double peak_mb() const { return peak_mb_; }
  int repeated() const { return repeated_; }
  /// The digest of all that it has answered.
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
