#include "sim/camera/shutter.h"

namespace etude {

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
    const double middle = 0.5 * (rows.first + rows.end) / height - 0.5;  // of the picture's height, from its middle
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

}  // namespace etude
