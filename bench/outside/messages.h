#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/files/json.h"

namespace etude {

/// Limits of a reply. A longer line is refused while it is read; JSON that is nested more deeply is refused before it
/// is parsed.
constexpr std::size_t kMaxReplyBytes = std::size_t{16} << 20;
constexpr int kMaxReplyDepth = 32;

/// These functions return the lines that Etude sends. `options` and `content` are JSON objects. `files` is the folder
/// of the attachments, or "" if there are none. The functions fail if a number is NaN or infinite.
Result<std::string> HelloLine(const std::string& task, const Json& options);
Result<std::string> SettingLine(const std::string& id, const Json& content, const std::string& files);
Result<std::string> ProblemLine(const std::string& id, const Json& content, const std::string& files);
/// BeginLine returns the line that begins a session, StepLine the line of its step `number`.
Result<std::string> BeginLine(const std::string& id, const Json& content, const std::string& files);
Result<std::string> StepLine(const std::string& id, int number, const Json& content, const std::string& files);

/// A program's reply to the handshake. Each function below reads one type of line. It fails if the line is not valid
/// JSON, is of another type, answers another problem, lacks a field, or has a field of the wrong type; the error says
/// what was found. Unknown fields are ignored.
struct HelloReply {
  std::string name;
  std::string version;
};
Result<HelloReply> ReadHello(const std::string& line);
Result<void> ReadReady(const std::string& line);
/// Returns the message, whose type is "answer" with an object `answer`, or "no_answer" with a text `reason`.
Result<Json> ReadAnswer(const std::string& line, const std::string& id);
/// Reads the answer to step `number` of a session, like ReadAnswer. A message of type "answer" must repeat the number.
Result<Json> ReadStepAnswer(const std::string& line, const std::string& id, int number);

/// The question that a line answers: the id of the problem or session and, in a session, the number of the step. `id`
/// is "" if the line is not an answer.
struct Answered {
  std::string id;
  std::optional<int> step = {};
};
Answered QuestionAnsweredBy(const std::string& line);

/// Puts a text in single quotes. If the text is longer than `max_bytes`, keeps only its first `max_bytes` bytes and
/// adds "…". Bytes that are not printable ASCII become \xNN.
std::string Printable(std::string_view text, std::size_t max_bytes = 80);

}  // namespace etude
