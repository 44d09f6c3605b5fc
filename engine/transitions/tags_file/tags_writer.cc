#include <fmt/core.h>
#include <fmt/ranges.h>
#include <libxml/xmlwriter.h>

#include <memory>

#include "engine/base/names.h"
#include "engine/transitions/tags_file/tags_file.h"

namespace etude {
namespace {

/// Writes XML elements and attributes with an indentation of two spaces.
class XmlWriter {
 public:
  XmlWriter() : buffer_(xmlBufferCreate(), xmlBufferFree), writer_(xmlNewTextWriterMemory(buffer_.get(), 0), Free) {
    xmlTextWriterSetIndent(writer_.get(), 1);
    xmlTextWriterSetIndentString(writer_.get(), Bytes("  "));
    xmlTextWriterStartDocument(writer_.get(), nullptr, "UTF-8", nullptr);
  }

  void Start(const char* element) { xmlTextWriterStartElement(writer_.get(), Bytes(element)); }
  void End() { xmlTextWriterEndElement(writer_.get()); }
  template <typename Value>
  void Attribute(std::string_view name, const Value& value) {
    xmlTextWriterWriteAttribute(writer_.get(), Bytes(std::string(name).c_str()),
                                Bytes(fmt::format("{}", value).c_str()));
  }
  std::string Finish() {
    xmlTextWriterEndDocument(writer_.get());
    return reinterpret_cast<const char*>(xmlBufferContent(buffer_.get()));
  }

 private:
  static const xmlChar* Bytes(const char* text) { return reinterpret_cast<const xmlChar*>(text); }
  static void Free(xmlTextWriter* writer) { xmlFreeTextWriter(writer); }

  std::unique_ptr<xmlBuffer, void (*)(xmlBuffer*)> buffer_;
  // This member is declared after the buffer, and therefore destroyed before it.
  std::unique_ptr<xmlTextWriter, void (*)(xmlTextWriter*)> writer_;
};

Result<void> CheckName(const std::string& name) {
  bool fits = !name.empty() && name.size() <= 4096 && xmlCheckUTF8(reinterpret_cast<const xmlChar*>(name.c_str()));
  for (char c : name) fits = fits && static_cast<unsigned char>(c) >= ' ';
  if (fits) return {};
  return Fail(
      {}, "the name of a clip is {}; allowed in a tags file: at most 4096 bytes of UTF-8 without control characters",
      Quote(name));
}

void WriteFrame(XmlWriter& xml, const TaggedFrame& frame, double rate_hz) {
  xml.Start("bridge-frame");
  xml.Attribute("frame", frame.frame);
  xml.Attribute("time-s", frame.frame / rate_hz);
  xml.Attribute("clips", frame.clips);
  xml.Attribute("difference", frame.difference);
  for (Feature feature : AllFeatures()) xml.Attribute(FeatureName(feature), TagName(frame.tags, feature));
  xml.Attribute("grades", fmt::format("{}", fmt::join(frame.grades, " ")));
  xml.End();
}

}  // namespace

Result<std::string> WriteTagsFile(const BridgeTags& tags) {
  RETURN_IF_ERROR(CheckName(tags.system));
  for (const ClipTags& clip : tags.clips) {
    for (const std::string& name : {clip.name, clip.source}) {
      RETURN_IF_ERROR(CheckName(name));
    }
  }
  XmlWriter xml;
  // Write the fuzzy system with its weights, the rules and the body.
  xml.Start("bridge-tags");
  xml.Attribute("version", 1);
  xml.Start("fuzzy-system");
  xml.Attribute("name", tags.system);
  xml.Attribute("memberships-digest", tags.memberships_digest);
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    xml.Start("weight");
    xml.Attribute("feature", FeatureName(AllFeatures()[k]));
    xml.Attribute("value", tags.weights[k]);
    xml.End();
  }
  xml.End();
  xml.Start("rules");
  xml.Attribute("threshold", tags.threshold);
  xml.Attribute("within-class", tags.within_class);
  xml.Attribute("min-clips", tags.min_clips);
  xml.Attribute("most-per-class", tags.most_per_class);
  xml.Attribute("max-neck-bend-deg", tags.max_neck_bend_deg);
  xml.Attribute("max-neck-turn-deg-per-s", tags.max_neck_turn_deg_per_s);
  xml.End();
  xml.Start("body");
  xml.Attribute("standing-hip-height-m", tags.standing_hip_height_m);
  xml.End();
  // Write the clips with their bridge frames, then the keys of the in-betweens.
  for (const ClipTags& clip : tags.clips) {
    xml.Start("clip");
    xml.Attribute("name", clip.name);
    xml.Attribute("source", clip.source);
    xml.Attribute("frames", clip.frames);
    xml.Attribute("rate-hz", clip.rate_hz);
    for (const TaggedFrame& frame : clip.bridge_frames) WriteFrame(xml, frame, clip.rate_hz);
    xml.End();
  }
  xml.Start("in-between");
  for (const KeyTag& key : tags.keys) {
    xml.Start("key");
    xml.Attribute("clip", key.clip);
    xml.Attribute("frame", key.frame);
    xml.End();
  }
  xml.End();
  xml.End();
  return xml.Finish();
}

}  // namespace etude
