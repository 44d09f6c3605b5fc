#include "io/drawing/pixel_lanes.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

// Splits a row of pixels into its three colour channels.
void Split(const unsigned char* pixels, int width, std::uint16_t* b, std::uint16_t* g, std::uint16_t* r) {
  for (int x = 0; x < width; ++x) {
    b[x] = pixels[4 * x];
    g[x] = pixels[4 * x + 1];
    r[x] = pixels[4 * x + 2];
  }
}

void Lightness(const std::uint16_t* b, const std::uint16_t* g, const std::uint16_t* r, int width, std::uint8_t* out) {
  for (int x = 0; x < width; ++x) {
    const auto sum = static_cast<std::uint16_t>(66 * r[x] + 129 * g[x] + 25 * b[x] + 128);
    out[x] = static_cast<std::uint8_t>((sum >> 8) + 16);
  }
}

}  // namespace

std::vector<Shrinker::Cover> Shrinker::CoversOf(int large, int small) {
  std::vector<Cover> covers(static_cast<std::size_t>(small));
  const double scale = static_cast<double>(large) / small;
  for (int i = 0; i < small; ++i) {
    Cover& cover = covers[static_cast<std::size_t>(i)];
    const double begin = i * scale, end = begin + scale;
    // Keep all taps (the large pixels that are read for one small pixel) within the picture, even taps of weight zero.
    cover.first = std::clamp(static_cast<int>(begin + 1e-9), 0, std::max(0, large - kTaps));
    int sum = 0, widest = 0;
    for (int k = 0; k < std::min(kTaps, large); ++k) {
      const double at = cover.first + k;
      const double share = std::max(0.0, std::min(end, at + 1) - std::max(begin, at)) / scale;
      cover.weights[k] = static_cast<std::uint16_t>(std::lround(256 * share));
      sum += cover.weights[k];
      if (cover.weights[k] > cover.weights[widest]) widest = k;
    }
    // Give the rounding remainder to the largest weight, so that the weights sum to 256.
    cover.weights[widest] = static_cast<std::uint16_t>(cover.weights[widest] + 256 - sum);
  }
  return covers;
}

Shrinker::Shrinker(int large_width, int large_height, int small_width, int small_height)
    : columns_(CoversOf(large_width, small_width)), rows_(CoversOf(large_height, small_height)) {}

void Shrinker::Shrink(const Image<std::uint32_t>& large, const PixelRect& rect, Image<std::uint32_t>& small) const {
  if (rect.IsEmpty()) return;
  // Find the small pixels that the rectangle touches, and the columns of large pixels that these small pixels cover.
  const auto from = [](const std::vector<Cover>& covers, int at, int size) {
    return static_cast<int>(static_cast<std::int64_t>(at) * static_cast<int>(covers.size()) / size);
  };
  const auto to = [&](const std::vector<Cover>& covers, int at, int size) {
    return std::min(from(covers, at, size) + 1, static_cast<int>(covers.size()));
  };
  const int left = from(columns_, rect.left, large.width), right = to(columns_, rect.right, large.width);
  const int top = from(rows_, rect.top, large.height), bottom = to(rows_, rect.bottom, large.height);
  const int first = columns_[static_cast<std::size_t>(left)].first;
  const int last = std::min(columns_[static_cast<std::size_t>(right) - 1].first + kTaps, large.width);
  std::vector<std::uint16_t> sums(4 * static_cast<std::size_t>(last - first + kTaps));
  // For each small row, first compute the weighted sum of its large rows. Then compute weighted sums of the columns of
  // this sum.
  for (int y = top; y < bottom; ++y) {
    const Cover& rows = rows_[static_cast<std::size_t>(y)];
    const int bytes = 4 * (last - first);
    const auto row = [&](int k) {
      const int at = std::min(rows.first + k, large.height - 1);
      return reinterpret_cast<const std::uint8_t*>(&large.At(first, at));
    };
    const std::uint8_t *a = row(0), *b = row(1), *c = row(2), *d = row(3);
    const std::uint16_t p = rows.weights[0], q = rows.weights[1], s = rows.weights[2], t = rows.weights[3];
    // Sum the rows; two taps are enough if all others have weight 0.
    std::uint16_t* sum = sums.data();
    if (s == 0 && t == 0) {
      for (int i = 0; i < bytes; ++i) sum[i] = static_cast<std::uint16_t>(a[i] * p + b[i] * q);
    } else {
      for (int i = 0; i < bytes; ++i) sum[i] = static_cast<std::uint16_t>(a[i] * p + b[i] * q + c[i] * s + d[i] * t);
    }
    // Sum the columns of each colour channel.
    std::uint32_t* out = &small.At(0, y);
    for (int x = left; x < right; ++x) {
      const Cover& columns = columns_[static_cast<std::size_t>(x)];
      const std::uint16_t* at = sum + 4 * (columns.first - first);
      std::uint32_t pixel = 0;
      for (int channel = 0; channel < 3; ++channel) {
        std::uint32_t level = 1u << 15;
        for (int k = 0; k < kTaps; ++k) level += static_cast<std::uint32_t>(at[4 * k + channel]) * columns.weights[k];
        pixel |= level >> 16 << (8 * channel);
      }
      out[x] = pixel;
    }
  }
}

void PixelsToI420(const unsigned char* pixels, int stride, int width, int height, std::uint8_t* planes) {
  const std::size_t count = static_cast<std::size_t>(width);
  std::vector<std::uint16_t> lines(6 * count);
  std::uint16_t* line[6];
  for (std::size_t i = 0; i < 6; ++i) line[i] = &lines[i * count];
  std::uint8_t* blue = planes + count * height;
  std::uint8_t* red = blue + count * height / 4;
  // Convert two rows at a time: luma for every pixel, chroma as the mean of 2 × 2 pixels.
  for (int y = 0; y < height; y += 2) {
    const unsigned char* upper = pixels + static_cast<std::ptrdiff_t>(y) * stride;
    Split(upper, width, line[0], line[1], line[2]);
    Split(upper + stride, width, line[3], line[4], line[5]);
    Lightness(line[0], line[1], line[2], width, planes + static_cast<std::size_t>(y) * width);
    Lightness(line[3], line[4], line[5], width, planes + static_cast<std::size_t>(y + 1) * width);
    for (int x = 0; x < width / 2; ++x) {
      const auto four = [&](int colour) {
        return line[colour][2 * x] + line[colour][2 * x + 1] + line[colour + 3][2 * x] + line[colour + 3][2 * x + 1];
      };
      const int b = four(0), g = four(1), r = four(2);
      *blue++ = static_cast<std::uint8_t>(((112 * b - 74 * g - 38 * r + 512) >> 10) + 128);
      *red++ = static_cast<std::uint8_t>(((112 * r - 94 * g - 18 * b + 512) >> 10) + 128);
    }
  }
}

}  // namespace etude
