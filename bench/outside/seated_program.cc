#include "bench/outside/seated_program.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

namespace etude {

SeatedProgram::SeatedProgram(OutsideMethod& method, std::string setting_id, const Payload& setting, std::string id)
    : method_(method), setting_id_(std::move(setting_id)), setting_(setting), id_(std::move(id)) {}

OutsideReply SeatedProgram::Note(OutsideReply reply) {
  cpu_s_ += reply.cpu_s;
  peak_mb_ = std::max(peak_mb_, reply.peak_mb);
  repeated_ += reply.repeated;
  was_asked_ = reply.was_asked;
  if (reply.status != Status::kOk) failure_ = CellResult::Ended(reply.status, reply.reason);
  return reply;
}

bool SeatedProgram::Begin(const Payload& session) {
  if (failure_) return false;
  const std::string id = sessions_++ == 0 ? id_ : fmt::format("{} ({})", id_, sessions_);
  return Note(method_.Begin(setting_id_, setting_, id, session)).status == Status::kOk;
}

JsonPtr SeatedProgram::Step(const Payload& step) {
  if (failure_) return nullptr;
  OutsideReply reply = Note(method_.Step(step));
  if (reply.answer != nullptr) answers_.Add(std::string_view(reply.answer->dump()));
  return std::move(reply.answer);
}

void SeatedProgram::End() {
  if (!failure_ && sessions_ > 0) Note(method_.EndSession());
}

}  // namespace etude
