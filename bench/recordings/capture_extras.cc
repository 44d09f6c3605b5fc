#include "bench/recordings/capture_extras.h"

#include <charconv>
#include <nlohmann/json.hpp>

namespace etude {
namespace {

using SortedJson = nlohmann::json;  // sorts keys alphabetically

constexpr const char* kFormat = "etude-capture";
constexpr int kVersion = 1;
constexpr int kMaxSide = 4096;  // maximum width and height of a picture, pixels

SortedJson ToJson(const CaptureExtras::View& view) {
  const Intrinsics& in = view.truth.intrinsics;
  SortedJson rotation = SortedJson::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rotation.push_back(view.truth.R_CW[column][row]);
  }
  SortedJson masks = SortedJson::array();
  for (const Mask& mask : view.masks) masks.push_back(EncodeMask(mask));
  const glm::dvec3& p = view.truth.p_WC;
  SortedJson json = {{"width", in.width},
                     {"height", in.height},
                     {"fx", in.fx},
                     {"fy", in.fy},
                     {"cx", in.cx},
                     {"cy", in.cy},
                     {"skew", in.skew},
                     {"R_CW", std::move(rotation)},
                     {"p_WC", {p.x, p.y, p.z}},
                     {"mask_width", view.masks.empty() ? 0 : view.masks[0].width},
                     {"mask_height", view.masks.empty() ? 0 : view.masks[0].height},
                     {"masks", std::move(masks)}};
  const Distortion& d = view.truth.distortion;
  if (!view.still_jpeg_base64.empty()) json["still"] = view.still_jpeg_base64;
  if (!d.IsNone()) json["distortion"] = {d.k1, d.k2, d.p1, d.p2, d.k3};
  return json;
}

SortedJson ToJson(const CaptureExtras::Moment& moment) {
  SortedJson fixed = SortedJson::array(), marks = SortedJson::array();
  for (const glm::dvec3& p : moment.fixed.joints) fixed.push_back({p.x, p.y, p.z});
  for (const std::vector<CaptureExtras::Mark>& drawn : moment.marks) {
    SortedJson of_camera = SortedJson::array();
    for (const CaptureExtras::Mark& mark : drawn) {
      of_camera.push_back({mark.a.x, mark.a.y, mark.b.x, mark.b.y, mark.colour.r, mark.colour.g, mark.colour.b});
    }
    marks.push_back(std::move(of_camera));
  }
  return {{"frame", moment.frame}, {"fixed", std::move(fixed)}, {"marks", std::move(marks)}};
}

CaptureExtras::Moment ToMoment(const SortedJson& json) {
  CaptureExtras::Moment moment;
  moment.frame = json.at("frame");
  for (std::size_t i = 0; i < moment.fixed.joints.size(); ++i) {
    const SortedJson& p = json.at("fixed").at(i);
    moment.fixed.joints[i] = {p.at(0), p.at(1), p.at(2)};
  }
  for (const SortedJson& of_camera : json.at("marks")) {
    std::vector<CaptureExtras::Mark>& drawn = moment.marks.emplace_back();
    for (const SortedJson& mark : of_camera) {
      drawn.push_back({{mark.at(0), mark.at(1)}, {mark.at(2), mark.at(3)}, {mark.at(4), mark.at(5), mark.at(6)}});
    }
  }
  return moment;
}

bool IsBase64(std::string_view text) {
  return text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=") == text.npos;
}

Result<CaptureExtras::View> ToView(const SortedJson& json) {
  CaptureExtras::View view;
  Intrinsics& in = view.truth.intrinsics;
  in = {json.at("width"), json.at("height"), json.at("fx"),  json.at("fy"),
        json.at("cx"),    json.at("cy"),     json.at("skew")};
  for (int i = 0; i < 9; ++i) view.truth.R_CW[i % 3][i / 3] = json.at("R_CW").at(i);
  for (int i = 0; i < 3; ++i) view.truth.p_WC[i] = json.at("p_WC").at(i);
  if (json.contains("distortion")) {
    const SortedJson& d = json.at("distortion");
    view.truth.distortion = {d.at(0), d.at(1), d.at(2), d.at(3), d.at(4)};
  }
  if (json.contains("still")) {
    view.still_jpeg_base64 = json.at("still");
    if (!IsBase64(view.still_jpeg_base64))
      return Fail({}, "the picture 'still' in this capture recording is not base64 text");
  }
  const int width = json.at("mask_width"), height = json.at("mask_height");
  for (const SortedJson& text : json.at("masks")) {
    ASSIGN_OR_RETURN(auto mask, DecodeMask(text.get_ref<const std::string&>(), width, height));
    view.masks.push_back(std::move(mask));
  }
  return view;
}

Result<CaptureExtras> ToExtras(const SortedJson& json) {
  if (json.at("format") != kFormat || json.at("version") != kVersion) {
    return Fail({}, "found a capture recording of format {}, version {}; this program reads format {}, version {}",
                json.at("format").dump(), json.at("version").dump(), kFormat, kVersion);
  }
  CaptureExtras extras;
  // Read the room, the scenery and the colours of the performer.
  extras.texture_seed = json.at("room").at("texture_seed");
  extras.casts_shadows = json.at("room").at("casts_shadows");
  if (json.contains("stage")) {
    const SortedJson& stage = json.at("stage");
    extras.stage_seed = stage.at("seed");
    extras.scene = stage.at("scene");
    extras.wears_everyday = stage.at("everyday");
    extras.wears_coded = stage.value("coded", false);
  }
  for (std::size_t i = 0; i < extras.colours.size(); ++i) {
    const SortedJson& colour = json.at("colours").at(i);
    extras.colours[i] = {colour.at(0), colour.at(1), colour.at(2)};
  }
  // Read the cameras and frames. Each camera has one mask for each frame, that is, for each entry of `brightness`.
  extras.brightness = json.at("brightness").get<std::vector<double>>();
  for (const SortedJson& camera : json.at("cameras")) {
    ASSIGN_OR_RETURN(auto view, ToView(camera));
    if (view.masks.size() != extras.brightness.size()) {
      return Fail(
          {},
          "found {} values of 'brightness' in a capture recording, but {} masks of a camera; allowed: equal numbers",
          extras.brightness.size(), view.masks.size());
    }
    extras.views.push_back(std::move(view));
  }
  // Read the moments, the frames whose intermediate results were kept. Each moment has marks for every camera.
  for (const SortedJson& json_moment : json.value("moments", SortedJson::array())) {
    extras.moments.push_back(ToMoment(json_moment));
    const CaptureExtras::Moment& moment = extras.moments.back();
    if (moment.frame >= extras.brightness.size() || moment.marks.size() != extras.views.size()) {
      return Fail(
          {},
          "in this capture recording, a moment has a frame that does not exist, or its marks do not match the cameras");
    }
  }
  extras.bvh = json.at("bvh");
  return extras;
}

}  // namespace

std::string WriteCaptureExtras(const CaptureExtras& extras) {
  SortedJson colours = SortedJson::array();
  for (const Rgb8& colour : extras.colours) colours.push_back({colour.r, colour.g, colour.b});
  SortedJson cameras = SortedJson::array();
  for (const CaptureExtras::View& view : extras.views) cameras.push_back(ToJson(view));
  SortedJson json = {{"format", kFormat},
                     {"version", kVersion},
                     {"room", {{"texture_seed", extras.texture_seed}, {"casts_shadows", extras.casts_shadows}}},
                     {"colours", std::move(colours)},
                     {"brightness", extras.brightness},
                     {"cameras", std::move(cameras)},
                     {"bvh", extras.bvh}};
  if (extras.scene > 0 || extras.wears_coded) {
    json["stage"] = {{"seed", extras.stage_seed}, {"scene", extras.scene}, {"everyday", extras.wears_everyday}};
    if (extras.wears_coded) json["stage"]["coded"] = true;
  }
  if (!extras.moments.empty()) {
    SortedJson moments = SortedJson::array();
    for (const CaptureExtras::Moment& moment : extras.moments) moments.push_back(ToJson(moment));
    json["moments"] = std::move(moments);
  }
  return json.dump();
}

Result<CaptureExtras> ReadCaptureExtras(std::string_view text) {
  if (text.find('\0') != std::string_view::npos)
    return Fail({}, "this capture recording cannot be read: it contains a zero byte");
  try {
    return ToExtras(SortedJson::parse(text));
  } catch (const SortedJson::exception& error) {
    return Fail({}, "this capture recording cannot be read: {}", error.what());
  }
}

std::string EncodeMask(const Mask& mask) {
  std::string text;
  std::size_t begin = 0;
  bool value = false;
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
    if ((mask.pixels[i] != 0) == value) continue;
    text += (text.empty() ? "" : " ") + std::to_string(i - begin);
    begin = i;
    value = !value;
  }
  if (value) text += " " + std::to_string(mask.pixels.size() - begin);
  return text;
}

Result<Mask> DecodeMask(std::string_view text, int width, int height) {
  if (width < 0 || height < 0 || width > kMaxSide || height > kMaxSide) {
    return Fail({}, "found a mask of {} × {} pixels; allowed: at most {} pixels on each side", width, height, kMaxSide);
  }
  Mask mask(width, height);
  std::size_t at = 0;
  bool value = false;
  const char* next = text.data();
  const char* const end = next + text.size();
  while (next != end) {
    std::size_t run = 0;
    const auto [rest, error] = std::from_chars(next, end, run);
    if (error != std::errc() || (rest != end && *rest != ' ') || run > mask.pixels.size() - at) {
      return Fail({}, "the run lengths of a mask are not numbers, or their sum exceeds {} × {} pixels", width, height);
    }
    std::fill_n(mask.pixels.begin() + static_cast<std::ptrdiff_t>(at), run, static_cast<std::uint8_t>(value));
    at += run;
    value = !value;
    next = rest == end ? end : rest + 1;
  }
  return mask;
}

Mask HalveMask(const Mask& mask) {
  Mask half(mask.width / 2, mask.height / 2);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      const int set =
          mask.At(2 * x, 2 * y) + mask.At(2 * x + 1, 2 * y) + mask.At(2 * x, 2 * y + 1) + mask.At(2 * x + 1, 2 * y + 1);
      half.At(x, y) = set >= 2;
    }
  }
  return half;
}

}  // namespace etude
