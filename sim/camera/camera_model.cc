#include "sim/camera/camera_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/camera/jpeg.h"
#include "sim/camera/lens.h"
#include "sim/camera/sensor.h"

namespace etude {
namespace {

RandomStream StreamOf(const CameraIdentity& identity, const std::string& purpose) {
  return {identity.world, identity.name + "/" + purpose};
}

Shutter MakeShutter(const CameraEffects& effects, double rate_hz, const CameraIdentity& identity) {
  RandomStream random = StreamOf(identity, "clock");
  return {effects, rate_hz, identity.is_reference, random};
}

AutomaticToning MakeToning(const CameraEffects& effects, const CameraIdentity& identity) {
  RandomStream exposure = StreamOf(identity, "exposure"), white_balance = StreamOf(identity, "white-balance");
  return {effects, exposure, white_balance};
}

/// Mixes two pictures in place: full + share · (demosaiced − full).
void Mix(const LightImage& demosaiced, float share, LightImage& full) {
  for (std::size_t i = 0; i < full.pixels.size(); ++i) {
    const Light& to = demosaiced.pixels[i];
    Light& from = full.pixels[i];
    from.r += share * (to.r - from.r);
    from.g += share * (to.g - from.g);
    from.b += share * (to.b - from.b);
  }
}

template <typename Pixel>
void CopyRows(const Image<Pixel>& source, const RowRange& rows, Image<Pixel>& out) {
  std::copy(source.pixels.begin(), source.pixels.end(), &out.At(0, rows.first));
}

}  // namespace

Shutter::Shutter(const CameraEffects& effects, double rate_hz, bool is_reference, RandomStream& random)
    : read_out_(effects.rolling_shutter_ms / 1000 * rate_hz), open_(effects.motion_blur) {
  const double late = random.Chance(0.5) ? 1 : -1, slow = random.Chance(0.5) ? 1 : -1;
  if (is_reference) return;
  offset_ = late * effects.sync_offset_ms / 1000 * rate_hz;
  drift_ = slow * effects.clock_drift_ppm / 1e6;
}

double Shutter::TimeOf(std::size_t frame) const { return static_cast<double>(frame) * (1 + drift_) + offset_; }

std::vector<Shutter::Band> Shutter::BandsOf(std::size_t frame, int height) const {
  if (read_out_ == 0) return {{{0, height}, TimeOf(frame)}};
  std::vector<Band> bands;
  for (int i = 0; i < kBands; ++i) {
    const RowRange rows{height * i / kBands, height * (i + 1) / kBands};
    if (rows.first == rows.end) continue;
    const double middle = 0.5 * (rows.first + rows.end) / height - 0.5;  // offset from the middle, in picture heights
    bands.push_back({rows, TimeOf(frame) + middle * read_out_});
  }
  return bands;
}

std::vector<double> Shutter::SubframesOf(const Band& band) const {
  if (open_ == 0) return {band.time};
  std::vector<double> times;
  for (int i = 0; i < kSubframes; ++i) times.push_back(band.time + ((i + 0.5) / kSubframes - 0.5) * open_);
  return times;
}

bool CameraModel::NeedsLight(const Camera& camera) const {
  const double strengths[] = {effects_.motion_blur, effects_.defocus_px,       effects_.vignette,
                              effects_.dust,        effects_.exposure_ev,      effects_.exposure_drift_ev,
                              effects_.bayer,       effects_.white_balance_ev, effects_.white_balance_drift_ev};
  return !camera.distortion.IsNone() ||
         std::any_of(std::begin(strengths), std::end(strengths), [](double strength) { return strength != 0; });
}

CameraModel::CameraModel(const Camera& camera, const CameraEffects& effects, double rate_hz, CameraIdentity identity)
    : effects_(effects),
      rate_hz_(rate_hz),
      identity_(std::move(identity)),
      width_(camera.intrinsics.width),
      height_(camera.intrinsics.height),
      lens_(camera),
      needs_light_(NeedsLight(camera)),
      shutter_(MakeShutter(effects, rate_hz, identity_)),
      toning_(MakeToning(effects, identity_)),
      noise_(WebcamNoise(effects.noise, effects.gain_db)) {
  // If no effect needs linear light, apply noise directly to 8-bit pictures.
  if (!needs_light_) {
    if (!noise_.IsNone()) code_noise_.emplace(noise_);
    return;
  }
  // Prepare the data that all pictures share.
  light_ = LightImage(width_, height_);
  if (effects_.defocus_px > 0) defocus_.emplace(effects_.defocus_px);
  if (effects_.vignette > 0 || effects_.dust > 0) transmission_.emplace(width_, height_, 1.0f);
  if (effects_.vignette > 0) AddVignette(camera, effects_.vignette, *transmission_);
  if (effects_.dust > 0) {
    RandomStream random = StreamOf(identity_, "dust");
    AddDust(DrawSpecks(width_, height_, random), effects_.dust, *transmission_);
  }
  if (effects_.bayer > 0) mosaic_ = Mosaic(width_, height_);
  if (effects_.bayer > 0) demosaiced_ = LightImage(width_, height_);
}

void CameraModel::AddLight(const Shutter::Band& band, const Scene& scene, const View& middle) {
  // Decode the pinhole's rows to linear light, averaged over the exposure.
  const RowRange rows = lens_.SourceRows(band.rows);
  const int width = pinhole().intrinsics.width, pixels = width * (rows.end - rows.first);
  if (!lens_.is_none()) {
    pinhole_light_.width = width;
    pinhole_light_.height = rows.end - rows.first;
    pinhole_light_.pixels.resize(static_cast<std::size_t>(pixels));
  }
  Light* out = lens_.is_none() ? &light_.At(0, rows.first) : pinhole_light_.pixels.data();
  const std::vector<double> times = shutter_.SubframesOf(band);
  if (times.size() == 1) {
    DecodeRow(middle.colour.pixels.data(), pixels, out);
  } else {
    std::fill_n(out, pixels, Light{});
    for (const double time : times) {
      const View view = scene(time, rows, Targets::kColour);
      AddDecodedRow(view.colour.pixels.data(), pixels, 1.0f / static_cast<float>(times.size()), out);
    }
  }
  // Warp the rows into the lens's picture.
  if (!lens_.is_none()) lens_.Warp(pinhole_light_, band.rows, light_);
}

void CameraModel::AddBand(const Shutter::Band& band, const Scene& scene, Targets targets, View& view) {
  const bool is_blurred = effects_.motion_blur > 0;
  const RowRange rows = lens_.SourceRows(band.rows);
  View middle;
  if (targets != Targets::kColour || !is_blurred) middle = scene(band.time, rows, targets);
  if (targets != Targets::kColour) lens_.Warp(middle.labels, band.rows, view.labels);
  if (targets == Targets::kAll) lens_.Warp(middle.depth, band.rows, view.depth);
  if (needs_light_) {
    AddLight(band, scene, middle);
  } else {
    CopyRows(middle.colour, band.rows, view.colour);
  }
}

void CameraModel::DevelopLight(double seconds, RandomStream& random, ColourImage& out) {
  // Blur. Then let the sensor read the light: a mosaic, full colours, or a mix of both.
  if (defocus_) defocus_->Apply(light_);
  const Sensor sensor{transmission_ ? &*transmission_ : nullptr, toning_.At(seconds), noise_};
  const LightImage* developed = &light_;
  if (effects_.bayer == 1) {
    sensor.ReadMosaic(light_, random, mosaic_);
    Demosaic(mosaic_, demosaiced_);
    developed = &demosaiced_;
  } else {
    sensor.ReadColours(random, light_);
  }
  if (effects_.bayer > 0 && effects_.bayer < 1) {
    RandomStream unused = random;
    Sensor{}.ReadMosaic(light_, unused, mosaic_);
    Demosaic(mosaic_, demosaiced_);
    Mix(demosaiced_, static_cast<float>(effects_.bayer), light_);
  }
  EncodeRow(developed->pixels.data(), width_ * height_, out.pixels.data());
}

View CameraModel::Develop(std::size_t frame, const Scene& scene, Targets targets, const std::string& noise_purpose) {
  // Render the frame in bands. A single band is returned without a copy if no effect needs linear light.
  View view;
  const std::vector<Shutter::Band> bands = shutter_.BandsOf(frame, height_);
  const bool is_plain = bands.size() == 1 && !needs_light_;
  if (is_plain) {
    view = scene(bands.front().time, bands.front().rows, targets);
  } else {
    view.colour = ColourImage(width_, height_);
    if (targets != Targets::kColour) view.labels = LabelImage(width_, height_);
    if (targets == Targets::kAll) view.depth = DepthImage(width_, height_);
    for (const Shutter::Band& band : bands) AddBand(band, scene, targets, view);
  }
  // Apply exposure, white balance and noise.
  RandomStream random = StreamOf(identity_, noise_purpose);
  if (needs_light_) {
    DevelopLight(static_cast<double>(frame) / rate_hz_, random, view.colour);
  } else if (code_noise_) {
    code_noise_->Apply(random, view.colour);
  }
  // Compress and decompress.
  if (effects_.jpeg_loss > 0) {
    const int quality = std::max(1, static_cast<int>(std::lround(100 - effects_.jpeg_loss)));
    DecodeJpeg(EncodeJpeg(view.colour, quality), view.colour);
  }
  return view;
}

View CameraModel::Shoot(std::size_t frame, const Scene& scene, Targets targets) {
  return Develop(frame, scene, targets, "noise/" + std::to_string(frame));
}

ColourImage CameraModel::ShootBackground(const Scene& scene) {
  return Develop(0, scene, Targets::kColour, "background").colour;
}

}  // namespace etude
