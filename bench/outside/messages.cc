#include "bench/outside/messages.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/outside/outside_method.h"
#include "io/files/json_text.h"

namespace etude {
namespace {

constexpr std::size_t kMaxNameLength = 200;

/// Returns "NaN", "Infinity" or "-Infinity" if the parser stopped at this word, which some programs write as a number;
/// else "". `byte` is counted from 1.
std::string_view NonFiniteAt(std::string_view line, std::size_t byte) {
  for (const std::string_view word : {"-Infinity", "Infinity", "NaN"}) {
    const std::size_t at = line.rfind(word, byte);
    if (at != std::string_view::npos && byte <= at + word.size()) return word;
  }
  return "";
}

/// Parses a line, which must be a JSON object with a text at `type`.
Result<Json> ReadMessage(const std::string& line) {
  if (NestingOf(line) > kMaxReplyDepth) {
    return Fail({}, "wrote something nested more than {} levels deep: {}", kMaxReplyDepth, Printable(line));
  }
  if (line.find('\0') != std::string::npos) return Fail({}, "wrote something that is not JSON: a zero byte");
  JsonText parsed = ParseJsonText(line);
  if (parsed.fault && parsed.fault->is_large_number)
    return Fail({}, "wrote a number that is too large: {}", Printable(line));
  if (parsed.fault) {
    if (const std::string_view word = NonFiniteAt(line, parsed.fault->byte); !word.empty())
      return Fail({}, "its message contains {}, which is not JSON; allowed: finite numbers", word);
    const std::size_t start = parsed.fault->byte > 40 ? parsed.fault->byte - 40 : 0;
    const std::string where = start == 0 ? "" : fmt::format(" near byte {}", parsed.fault->byte);
    return Fail({}, "wrote something that is not JSON{}: {}", where,
                Printable(std::string_view(line).substr(std::min(start, line.size()))));
  }
  // Fail on duplicate keys, because JSON parsers differ in which of the two values they use.
  if (parsed.repeated_key) {
    return Fail({}, "wrote the key {} twice in one object: {}", Printable(*parsed.repeated_key), Printable(line));
  }
  Json message = std::move(parsed.value);
  if (!message.is_object() || !message.contains("type") || !message["type"].is_string()) {
    return Fail({}, "wrote something that is not a message with a \"type\": {}", Printable(line));
  }
  return message;
}

Result<std::string> TextOf(const Json& message, const char* key, const std::string& line) {
  if (message.contains(key) && message[key].is_string()) return message[key].get<std::string>();
  return Fail({}, "its message '{}' has no text with the key \"{}\": {}", message["type"].get<std::string>(), key,
              Printable(line));
}

Result<Json> ReadMessageOfType(const std::string& line, std::string_view type) {
  auto message = ReadMessage(line);
  if (message && (*message)["type"] != type)
    return Fail({}, "did not write the message '{}': {}", type, Printable(line));
  return message;
}

Json Message(const char* type, const std::string& id, const Json& content, const std::string& files) {
  Json message{{"type", type}, {"id", id}, {type, content}};
  if (!files.empty()) message["files"] = files;
  return message;
}

}  // namespace

Result<std::string> HelloLine(const std::string& task, const Json& options) {
  return WriteJson({{"type", "hello"}, {"protocol", kProtocolVersion}, {"task", task}, {"options", options}});
}

Result<std::string> SettingLine(const std::string& id, const Json& content, const std::string& files) {
  return WriteJson(Message("setting", id, content, files));
}

Result<std::string> ProblemLine(const std::string& id, const Json& content, const std::string& files) {
  return WriteJson(Message("problem", id, content, files));
}

Result<std::string> BeginLine(const std::string& id, const Json& content, const std::string& files) {
  return WriteJson(Message("begin", id, content, files));
}

Result<std::string> StepLine(const std::string& id, int number, const Json& content, const std::string& files) {
  Json message = Message("step", id, content, files);
  message["number"] = number;
  return WriteJson(message);
}

Result<HelloReply> ReadHello(const std::string& line) {
  ASSIGN_OR_RETURN(const auto message, ReadMessageOfType(line, "hello"));
  if (!message.contains("protocol") || message["protocol"] != kProtocolVersion) {
    return Fail({}, "does not support protocol {}: {}", kProtocolVersion, Printable(line));
  }
  ASSIGN_OR_RETURN(const auto name, TextOf(message, "name", line));
  ASSIGN_OR_RETURN(const auto version, TextOf(message, "version", line));
  return HelloReply{name.substr(0, kMaxNameLength), version.substr(0, kMaxNameLength)};
}

Result<void> ReadReady(const std::string& line) {
  RETURN_IF_ERROR(ReadMessageOfType(line, "ready"));
  return {};
}

Result<Json> ReadAnswer(const std::string& line, const std::string& id) {
  auto message = ReadMessage(line);
  if (!message) return message;
  const bool is_answer = (*message)["type"] == "answer";
  if (!is_answer && (*message)["type"] != "no_answer") {
    return Fail({}, "wrote neither 'answer' nor 'no_answer': {}", Printable(line));
  }
  ASSIGN_OR_RETURN(const auto said_id, TextOf(*message, "id", line));
  if (said_id != id) return Fail({}, "answered {} when asked {}", Printable(said_id), Printable(id));
  if (!is_answer) {
    RETURN_IF_ERROR(TextOf(*message, "reason", line));
  } else if (!message->contains("answer") || !(*message)["answer"].is_object()) {
    return Fail({}, "its message 'answer' has no object with the key \"answer\": {}", Printable(line));
  }
  return message;
}

Result<Json> ReadStepAnswer(const std::string& line, const std::string& id, int number) {
  ASSIGN_OR_RETURN(auto message, ReadAnswer(line, id));
  if (message["type"] == "answer" && (!message.contains("number") || message["number"] != number)) {
    return Fail({}, "answered a step other than {}: {}", number, Printable(line));
  }
  return message;
}

Answered QuestionAnsweredBy(const std::string& line) {
  const auto message = ReadMessage(line);
  if (!message || ((*message)["type"] != "answer" && (*message)["type"] != "no_answer")) return {};
  Answered answered{TextOf(*message, "id", line).value_or("")};
  if (message->contains("number") && (*message)["number"].is_number_integer()) {
    answered.step = (*message)["number"].get<int>();
  }
  return answered;
}

std::string Printable(std::string_view text, std::size_t max_bytes) {
  std::string result = "'";
  for (const char c : text.substr(0, max_bytes)) {
    if (c >= ' ' && c <= '~') {
      result += c;
    } else {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
  }
  return result + (text.size() > max_bytes ? "…'" : "'");
}

}  // namespace etude
