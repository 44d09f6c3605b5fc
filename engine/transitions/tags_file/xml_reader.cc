#include "engine/transitions/tags_file/xml_reader.h"

#include <libxml/xmlreader.h>
#include <libxml/xmlschemas.h>

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

namespace etude {
namespace {

template <typename T, void (*Free)(T*)>
struct Freer {
  void operator()(T* held) const { Free(held); }
};
template <typename T, void (*Free)(T*)>
using Held = std::unique_ptr<T, Freer<T, Free>>;

Held<xmlSchema, xmlSchemaFree> Compile(std::string_view schema) {
  const Held<xmlSchemaParserCtxt, xmlSchemaFreeParserCtxt> context(
      xmlSchemaNewMemParserCtxt(schema.data(), static_cast<int>(schema.size())));
  Held<xmlSchema, xmlSchemaFree> compiled(xmlSchemaParse(context.get()));
  assert(compiled && "the schema is ours");
  return compiled;
}

int LineOf(std::string_view text, std::size_t at) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

/// Refuses what libxml2 would expand, or take minutes for.
Result<void> CheckBeforeParsing(std::string_view text, const std::string& file) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return Fail({file, 0, 0}, "is empty; etude bridge writes tags files");
  }
  if (const std::size_t at = text.find("<!DOCTYPE"); at != std::string_view::npos) {
    return Fail({file, LineOf(text, at), 0},
                "a document type declaration; a tags file has none (entities are not expanded)");
  }
  // Long enough for two names of 4096 bytes written as &quot; entities. A limit, because libxml2 takes quadratic time
  // in the number of a tag's attributes.
  constexpr std::size_t kLongestTag = 65536;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t next = std::min(text.find('<', start + 1), text.size());
    if (next - start > kLongestTag) {
      return Fail({file, LineOf(text, start), 0}, "{} bytes without a new tag; a tags file has up to {}", next - start,
                  kLongestTag);
    }
    start = next;
  }
  return {};
}

std::string OneLine(const char* message) {
  std::string line = message ? message : "no reason given";
  while (!line.empty() && (line.back() == '\n' || line.back() == '.' || line.back() == ' ')) line.pop_back();
  constexpr std::size_t kLongest = 500;
  if (line.size() > kLongest) line = line.substr(0, kLongest) + "…";
  return line;
}

}  // namespace

struct XmlReader::State {
  std::string file;
  std::string text;  // what the reader reads
  std::optional<Error> complaint;
  Held<xmlSchema, xmlSchemaFree> schema;
  Held<xmlTextReader, xmlFreeTextReader> reader;  // gone before its schema

  /// libxml2's way to complain. The first complaint counts: later ones may follow from it. Warnings count, too: no
  /// tags file gives cause for one.
  static void Complain(void* self, xmlErrorPtr error) {
    State& state = *static_cast<State*>(self);
    if (state.complaint) return;
    const int line = error->line > 0 ? error->line : state.Line();
    state.complaint = Error{{state.file, line, 0}, OneLine(error->message)};
  }
  /// Begins the text anew. The encoding is told, so that no other can hide a declaration from us.
  void Start() {
    reader.reset(xmlReaderForMemory(text.data(), static_cast<int>(text.size()), nullptr, "UTF-8", XML_PARSE_NONET));
    if (reader) Listen();
  }
  void Listen() { xmlTextReaderSetStructuredErrorHandler(reader.get(), Complain, this); }
  int Line() const { return reader ? xmlTextReaderGetParserLineNumber(reader.get()) : 0; }
};

XmlReader::XmlReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
XmlReader::XmlReader(XmlReader&&) noexcept = default;
XmlReader& XmlReader::operator=(XmlReader&&) noexcept = default;
XmlReader::~XmlReader() = default;

Result<XmlReader> XmlReader::Open(std::string_view text, std::string_view schema, const std::string& file) {
  auto state = std::make_unique<State>();
  state->file = file;
  state->text = text;
  state->schema = Compile(schema);
  RETURN_IF_ERROR(CheckBeforeParsing(text, file));
  // Parsed twice, first without the schema: libxml2 2.9 crashes when a syntax error or a warning occurs while it
  // validates.
  state->Start();
  int read = 1;
  while (state->reader && read == 1 && !state->complaint) read = xmlTextReaderRead(state->reader.get());
  if (state->complaint) return tl::unexpected(*state->complaint);
  if (!state->reader || read != 0) return Fail({file, 0, 0}, "cannot be read as XML");
  state->Start();
  xmlTextReaderSetSchema(state->reader.get(), state->schema.get());
  state->Listen();
  return XmlReader(std::move(state));
}

Result<bool> XmlReader::Next() {
  xmlTextReader* reader = state_->reader.get();
  while (true) {
    const int read = xmlTextReaderRead(reader);
    if (state_->complaint) return tl::unexpected(*state_->complaint);
    if (read < 0) return Fail({state_->file, state_->Line(), 0}, "cannot be read as XML");
    if (read == 0) return false;
    if (xmlTextReaderNodeType(reader) == XML_READER_TYPE_ELEMENT) return true;
  }
}

std::string XmlReader::Element() const {
  return reinterpret_cast<const char*>(xmlTextReaderConstName(state_->reader.get()));
}

std::string XmlReader::Attribute(std::string_view name) const {
  const std::string with_end(name);
  xmlChar* value = xmlTextReaderGetAttribute(state_->reader.get(), reinterpret_cast<const xmlChar*>(with_end.c_str()));
  if (value == nullptr) return "";
  std::string copy(reinterpret_cast<const char*>(value));
  xmlFree(value);
  return copy;
}

Place XmlReader::Where() const {
  xmlNode* node = xmlTextReaderCurrentNode(state_->reader.get());
  return {state_->file, static_cast<int>(xmlGetLineNo(node)), 0};
}

}  // namespace etude
