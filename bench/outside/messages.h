#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/files/json.h"

namespace etude {

/// Longer lines are refused while they are read, deeper JSON before it is parsed.
constexpr std::size_t kMaxReplyBytes = std::size_t{16} << 20;
constexpr int kMaxReplyDepth = 32;

/// Write the lines that Etude says. `options` and `content` are objects; `files` is the folder of the attachments, ""
/// when there are none. Fail when `content` holds a number that is not finite.
Result<std::string> HelloLine(const std::string& task, const Json& options);
Result<std::string> SettingLine(const std::string& id, const Json& content, const std::string& files);
Result<std::string> ProblemLine(const std::string& id, const Json& content, const std::string& files);
/// Write the beginning of a session that goes on step by step, and step `number` of it.
Result<std::string> BeginLine(const std::string& id, const Json& content, const std::string& files);
Result<std::string> StepLine(const std::string& id, int number, const Json& content, const std::string& files);

/// A program's reply to the handshake. The functions below read the lines that it may say. Each fails on anything else,
/// with what was found: a line that is not JSON, of another type, about another problem, without a field or with one of
/// the wrong type. Fields that are not known are ignored.
struct HelloReply {
  std::string name;
  std::string version;
};
Result<HelloReply> ReadHello(const std::string& line);
Result<void> ReadReady(const std::string& line);
/// Reads the whole line: of type "answer", with an object `answer`, or of type "no_answer", with a text `reason`.
Result<Json> ReadAnswer(const std::string& line, const std::string& id);
/// Reads such a line about step `number`, which an "answer" must repeat.
Result<Json> ReadStepAnswer(const std::string& line, const std::string& id, int number);

/// The problem, and the step of a session, that a line answers; `id` is empty when it answers none.
struct Answered {
  std::string id;
  std::optional<int> step = {};
};
Answered QuestionAnsweredBy(const std::string& line);

/// Quotes the first `longest` bytes in single quotes, what is no printable ASCII as \xNN.
std::string Printable(std::string_view text, std::size_t longest = 80);

}  // namespace etude
