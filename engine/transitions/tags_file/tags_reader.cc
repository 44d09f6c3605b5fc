#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "engine/base/names.h"
#include "engine/transitions/tags_file/schema.h"
#include "engine/transitions/tags_file/tags_file.h"
#include "engine/transitions/tags_file/xml_reader.h"

namespace etude {
namespace {

/// Fills BridgeTags element by element. The schema has seen to it that all are there, in order and of the right kind.
class TagsReader {
 public:
  explicit TagsReader(XmlReader& xml) : xml_(xml) {}

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
  /// The first complaint of the element counts.
  template <typename... Args>
  void Complain(fmt::format_string<Args...> format, Args&&... args) {
    if (!complaint_) complaint_ = Error{xml_.Where(), fmt::format(format, std::forward<Args>(args)...)};
  }

  template <typename T>
  T Parse(std::string_view name, std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      Complain("{} is {}; written is a plain number", name, Quote(text));
    }
    return value;
  }
  double Number(std::string_view name) { return Parse<double>(name, xml_.Attribute(name)); }
  int Whole(std::string_view name) { return Parse<int>(name, xml_.Attribute(name)); }

  void ReadWeight() {
    if (weights_read_ == kFeatureCount) return Complain("more than {} weights", kFeatureCount);
    const Feature expected = AllFeatures()[weights_read_++];
    const std::string name = xml_.Attribute("feature");
    if (name != FeatureName(expected)) {
      return Complain("the weight of {}; in this place stands that of {}", name, FeatureName(expected));
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
    TaggedFrame frame;
    frame.frame = Whole("frame");
    frame.clips = Whole("clips");
    frame.difference = Number("difference");
    ReadGrades(frame.grades);
    if (complaint_) return;
    frame.tags = ChooseTags(frame.grades);
    for (Feature feature : AllFeatures()) {
      const std::string tag = xml_.Attribute(FeatureName(feature));
      if (tag != TagName(frame.tags, feature)) {
        return Complain("{} is tagged {}, but by its grades it is {}", FeatureName(feature), Quote(tag),
                        TagName(frame.tags, feature));
      }
    }
    if (frame.frame >= clip.frames) {
      return Complain("frame {} of a clip that has {}; they count from 0", frame.frame, clip.frames);
    }
    if (!clip.bridge_frames.empty() && frame.frame <= clip.bridge_frames.back().frame) {
      return Complain("frame {} after frame {}; bridge frames rise", frame.frame, clip.bridge_frames.back().frame);
    }
    const double time_s = Number("time-s"), expected_s = frame.frame / clip.rate_hz;
    constexpr double kRoundingOfFile = 1e-6;
    if (std::abs(time_s - expected_s) > kRoundingOfFile * (1 + expected_s)) {
      return Complain("time-s is {}, but frame {} at {} Hz is at {}", time_s, frame.frame, clip.rate_hz, expected_s);
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
    if (clip == clip_of_name_.end()) return Complain("a key of clip {}, which the file does not have", Quote(key.clip));
    const bool has_bridge_frames = std::any_of(tags_.clips.begin(), tags_.clips.end(),
                                               [](const ClipTags& tagged) { return !tagged.bridge_frames.empty(); });
    const ClipTags& of_clip = tags_.clips[clip->second];
    const auto is_it = [&](const TaggedFrame& frame) { return frame.frame == key.frame; };
    const bool is_bridge_frame = std::any_of(of_clip.bridge_frames.begin(), of_clip.bridge_frames.end(), is_it);
    // In a library without any bridge frame, keys may be any frames.
    if (has_bridge_frames ? !is_bridge_frame : key.frame >= of_clip.frames) {
      return Complain("a key at frame {} of clip {}, which is no bridge frame", key.frame, Quote(key.clip));
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
  if (text.size() > kLargestTagsFile) {
    return Fail({file, 0, 0}, "{} bytes; a tags file has up to {}", text.size(), kLargestTagsFile);
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
