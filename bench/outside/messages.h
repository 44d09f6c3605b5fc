#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/files/json.h"

namespace etude {

/// Limits of a reply: longer lines are refused during reading, more deeply nested JSON before parsing.
constexpr std::size_t kMaxReplyBytes = std::size_t{16} << 20;
constexpr int kMaxReplyDepth = 32;

/// Return the lines that Etude sends. `options` and `content` are objects; `files` is the folder of the attachments, ""
/// if there are none. Fail on NaN and infinity.
Result<std::string> HelloLine(const std::string& task, const Json& options);
Result<std::string> SettingLine(const std::string& id, const Json& content, const std::string& files);
Result<std::string> ProblemLine(const std::string& id, const Json& content, const std::string& files);
/// Return the line that begins a session, and the line of its step `number`.
Result<std::string> BeginLine(const std::string& id, const Json& content, const std::string& files);
Result<std::string> StepLine(const std::string& id, int number, const Json& content, const std::string& files);

/// A program's reply to the handshake. Each function below reads one type of line and fails on anything else: invalid
/// JSON, another type or problem, a missing field, or a field of the wrong type. The error says what was found. Unknown
/// fields are ignored.
struct HelloReply {
  std::string name;
  std::string version;
};
Result<HelloReply> ReadHello(const std::string& line);
Result<void> ReadReady(const std::string& line);
/// Returns the message: type "answer" with an object `answer`, or type "no_answer" with a text `reason`.
Result<Json> ReadAnswer(const std::string& line, const std::string& id);
/// The same for step `number` of a session; an "answer" must repeat the number.
Result<Json> ReadStepAnswer(const std::string& line, const std::string& id, int number);

/// The problem, and the step of a session, that a line answers; `id` is "" if the line is not an answer.
struct Answered {
  std::string id;
  std::optional<int> step = {};
};
Answered QuestionAnsweredBy(const std::string& line);

/// Returns the first `max_bytes` bytes in single quotes; bytes other than printable ASCII become \xNN.
std::string Printable(std::string_view text, std::size_t max_bytes = 80);

}  // namespace etude
