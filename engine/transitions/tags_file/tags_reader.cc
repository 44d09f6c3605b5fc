#include <fmt/core.h>
#include <libxml/xmlreader.h>
#include <libxml/xmlschemas.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/base/names.h"
#include "engine/base/result.h"
#include "engine/base/text.h"
#include "engine/transitions/tags_file/tags_file.h"

namespace etude {
namespace {

/// Reads an XML document element by element, and validates it against a schema. It loads nothing outside the text,
/// expands no entities, and rejects a document type declaration.
class XmlReader {
 public:
  static Result<XmlReader> Open(std::string_view text, std::string_view schema, const std::string& file);
  XmlReader(XmlReader&&) noexcept;
  XmlReader& operator=(XmlReader&&) noexcept;
  ~XmlReader();

  /// Goes to the next start tag; returns false at the end of a valid document.
  Result<bool> Next();
  /// Element returns the element's name; Attribute returns the value of one of its attributes, or "" if it is missing.
  std::string Element() const;
  std::string Attribute(std::string_view name) const;
  /// Returns the position (file and line) at which the element starts.
  Place Where() const;

 private:
  struct State;
  explicit XmlReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

template <typename T, void (*Free)(T*)>
struct XmlDeleter {
  void operator()(T* held) const { Free(held); }
};

template <typename T, void (*Free)(T*)>
using XmlPtr = std::unique_ptr<T, XmlDeleter<T, Free>>;

XmlPtr<xmlSchema, xmlSchemaFree> Compile(std::string_view schema) {
  const XmlPtr<xmlSchemaParserCtxt, xmlSchemaFreeParserCtxt> context(
      xmlSchemaNewMemParserCtxt(schema.data(), static_cast<int>(schema.size())));
  XmlPtr<xmlSchema, xmlSchemaFree> compiled(xmlSchemaParse(context.get()));
  assert(compiled && "the schema is ours");
  return compiled;
}

int LineOf(std::string_view text, std::size_t at) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

/// Rejects documents that would make libxml2 expand entities or take quadratic time.
Result<void> CheckBeforeParsing(std::string_view text, const std::string& file) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return Fail({file, 0, 0}, "the file is empty; use `etude bridge` to write a tags file");
  }
  if (const std::size_t at = text.find("<!DOCTYPE"); at != std::string_view::npos) {
    return Fail({file, LineOf(text, at), 0}, "found a document type declaration (<!DOCTYPE); allowed: none");
  }
  // libxml2 takes quadratic time in the number of a tag's attributes, so the length of a tag is limited. The limit
  // allows two names of 4096 bytes whose characters are all written as &quot; entities.
  constexpr std::size_t kMaxTagBytes = 65536;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t next = std::min(text.find('<', start + 1), text.size());
    if (next - start > kMaxTagBytes) {
      return Fail({file, LineOf(text, start), 0}, "found {} bytes without a new XML tag; allowed: at most {}",
                  next - start, kMaxTagBytes);
    }
    start = next;
  }
  return {};
}

std::string OneLine(const char* message) {
  std::string line = message ? message : "no reason given";
  while (!line.empty() && (line.back() == '\n' || line.back() == '.' || line.back() == ' ')) line.pop_back();
  constexpr std::size_t kMaxBytes = 500;
  if (line.size() > kMaxBytes) line = line.substr(0, kMaxBytes) + "…";
  return line;
}

struct XmlReader::State {
  std::string file;
  std::string text;  // the document, which `reader` reads in place
  std::optional<Error> complaint;
  XmlPtr<xmlSchema, xmlSchemaFree> schema;
  XmlPtr<xmlTextReader, xmlFreeTextReader> reader;  // declared after the schema, and therefore destroyed before it

  /// The error handler of libxml2. Only the first error is kept, because it may cause the later ones. Warnings count as
  /// errors, because no valid tags file causes a warning. The handler is a template because libxml2 2.12 made the
  /// handler's error const.
  template <typename ErrorPointer>
  static void Complain(void* self, ErrorPointer error) {
    State& state = *static_cast<State*>(self);
    if (state.complaint) return;
    const int line = error->line > 0 ? error->line : state.Line();
    state.complaint = Error{{state.file, line, 0}, OneLine(error->message)};
  }
  /// Starts to read the text from its beginning. The encoding is fixed, because another encoding could hide a document
  /// type declaration.
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
  // Parse the text twice, first without the schema: libxml2 2.9 crashes if a syntax error or a warning occurs during
  // validation.
  state->Start();
  int read = 1;
  while (state->reader && read == 1 && !state->complaint) read = xmlTextReaderRead(state->reader.get());
  if (state->complaint) return tl::unexpected(*state->complaint);
  if (!state->reader || read != 0) return Fail({file, 0, 0}, "the file cannot be read as XML");
  // Start again with validation.
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
    if (read < 0) return Fail({state_->file, state_->Line(), 0}, "the file cannot be read as XML");
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

/// Fills BridgeTags element by element. The schema guarantees the presence, order and kind of all elements.
class TagsReader {
 public:
  explicit TagsReader(XmlReader& xml) : xml_(xml) {}

  /// Reads the current element into the tags. Returns the element's first error.
  Result<void> ReadElement() {
    const std::string element = xml_.Element();
    if (element == "fuzzy-system") {
      tags_.system = xml_.Attribute("name");
      tags_.memberships_digest = xml_.Attribute("memberships-digest");
    } else if (element == "weight") {
      ReadWeight();
    } else if (element == "rules") {
      tags_.threshold = Number("threshold");
      tags_.within_class = xml_.Attribute("within-class") == "true";
      tags_.min_clips = Whole("min-clips");
      tags_.most_per_class = Whole("most-per-class");
      tags_.max_neck_bend_deg = Number("max-neck-bend-deg");
      tags_.max_neck_turn_deg_per_s = Number("max-neck-turn-deg-per-s");
    } else if (element == "body") {
      tags_.standing_hip_height_m = Number("standing-hip-height-m");
    } else if (element == "clip") {
      ReadClip();
    } else if (element == "bridge-frame") {
      ReadFrame();
    } else if (element == "key") {
      ReadKey();
    }
    if (complaint_) return tl::unexpected(*complaint_);
    return {};
  }

  BridgeTags Take() { return std::move(tags_); }

 private:
  /// Records an error, unless the element already has one.
  template <typename... Args>
  void Complain(fmt::format_string<Args...> format, Args&&... args) {
    if (!complaint_) complaint_ = Error{xml_.Where(), fmt::format(format, std::forward<Args>(args)...)};
  }

  template <typename T>
  T Parse(std::string_view name, std::string_view text) {
    const auto value = ParseNumber<T>(text);
    if (!value) Complain("{} is {}; allowed: a plain number", name, Quote(text));
    return value.value_or(T{});
  }
  double Number(std::string_view name) { return Parse<double>(name, xml_.Attribute(name)); }
  int Whole(std::string_view name) { return Parse<int>(name, xml_.Attribute(name)); }

  void ReadWeight() {
    if (weights_read_ == kFeatureCount) return Complain("more than {} weights", kFeatureCount);
    const Feature expected = AllFeatures()[weights_read_++];
    const std::string name = xml_.Attribute("feature");
    if (name != FeatureName(expected)) {
      return Complain("found the weight of {}; expected the weight of {}", name, FeatureName(expected));
    }
    tags_.weights[static_cast<std::size_t>(expected)] = Number("value");
  }

  void ReadClip() {
    ClipTags& clip = tags_.clips.emplace_back();
    clip.name = xml_.Attribute("name");
    clip.source = xml_.Attribute("source");
    clip.frames = Whole("frames");
    clip.rate_hz = Number("rate-hz");
    const std::size_t index = tags_.clips.size() - 1;
    if (!clip_of_name_.emplace(clip.name, index).second) Complain("a second clip is called {}", Quote(clip.name));
  }

  void ReadFrame() {
    ClipTags& clip = tags_.clips.back();
    // Read the numbers and the grades of a frame.
    TaggedFrame frame;
    frame.frame = Whole("frame");
    frame.clips = Whole("clips");
    frame.difference = Number("difference");
    ReadGrades(frame.grades);
    if (complaint_) return;
    // The tags must follow from the grades.
    frame.tags = ChooseTags(frame.grades);
    for (Feature feature : AllFeatures()) {
      const std::string tag = xml_.Attribute(FeatureName(feature));
      if (tag != TagName(frame.tags, feature)) {
        return Complain("the tag of {} is {}, but the grades give the tag {}", FeatureName(feature), Quote(tag),
                        TagName(frame.tags, feature));
      }
    }
    // The frame must lie in the clip and after the previous one, and its time must follow from its index.
    if (frame.frame >= clip.frames) {
      return Complain("found frame {} in a clip of {} frames; frames are counted from 0", frame.frame, clip.frames);
    }
    if (!clip.bridge_frames.empty() && frame.frame <= clip.bridge_frames.back().frame) {
      return Complain("found frame {} after frame {}; allowed: increasing numbers of bridge frames", frame.frame,
                      clip.bridge_frames.back().frame);
    }
    const double time_s = Number("time-s"), expected_s = frame.frame / clip.rate_hz;
    constexpr double kRoundingOfFile = 1e-6;
    if (std::abs(time_s - expected_s) > kRoundingOfFile * (1 + expected_s)) {
      return Complain("time-s is {}, but frame {} at {} Hz is at {} s", time_s, frame.frame, clip.rate_hz, expected_s);
    }
    clip.bridge_frames.push_back(frame);
  }

  void ReadGrades(Grades& grades) {
    const std::string text = xml_.Attribute("grades");
    std::size_t at = 0;
    for (double& grade : grades) {
      const std::size_t end = std::min(text.find(' ', at), text.size());
      grade = Parse<double>("a grade", std::string_view(text).substr(at, end - at));
      at = std::min(end + 1, text.size());
    }
  }

  void ReadKey() {
    const KeyTag key{xml_.Attribute("clip"), Whole("frame")};
    const auto clip = clip_of_name_.find(key.clip);
    if (clip == clip_of_name_.end())
      return Complain("a key pose refers to clip {}, which is not in the file", Quote(key.clip));
    const bool has_bridge_frames = std::any_of(tags_.clips.begin(), tags_.clips.end(),
                                               [](const ClipTags& tagged) { return !tagged.bridge_frames.empty(); });
    const ClipTags& of_clip = tags_.clips[clip->second];
    const auto is_it = [&](const TaggedFrame& frame) { return frame.frame == key.frame; };
    const bool is_bridge_frame = std::any_of(of_clip.bridge_frames.begin(), of_clip.bridge_frames.end(), is_it);
    // In a library without bridge frames, any frame may be a key.
    if (has_bridge_frames ? !is_bridge_frame : key.frame >= of_clip.frames) {
      return Complain("a key pose refers to frame {} of clip {}, which is not a bridge frame", key.frame,
                      Quote(key.clip));
    }
    tags_.keys.push_back(key);
  }

  XmlReader& xml_;
  BridgeTags tags_;
  std::optional<Error> complaint_;
  std::size_t weights_read_ = 0;
  std::map<std::string, std::size_t> clip_of_name_;
};

}  // namespace

Result<BridgeTags> ReadTagsFile(std::string_view text, const std::string& file) {
  if (text.size() > kMaxTagsFileBytes) {
    return Fail({file, 0, 0}, "found {} bytes; allowed: at most {}", text.size(), kMaxTagsFileBytes);
  }
  ASSIGN_OR_RETURN(auto xml, XmlReader::Open(text, TagsFileSchemas().front().text, file));
  TagsReader reader(xml);
  while (true) {
    ASSIGN_OR_RETURN(const auto more, xml.Next());
    if (!more) return reader.Take();
    RETURN_IF_ERROR(reader.ReadElement());
  }
}

}  // namespace etude
