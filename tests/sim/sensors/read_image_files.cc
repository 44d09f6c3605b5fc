#include "tests/sim/sensors/read_image_files.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <png.h>

#include <cmath>
#include <exception>
#include <vector>

namespace etude {
namespace {

std::uint8_t ToByte(half value) { return static_cast<std::uint8_t>(std::lround(static_cast<float>(value) * 255)); }

}  // namespace

std::optional<ColourImage> ReadColourPng(const std::string& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, path.c_str())) return std::nullopt;
  png.format = PNG_FORMAT_RGB;
  ColourImage image(static_cast<int>(png.width), static_cast<int>(png.height));
  if (!png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr)) return std::nullopt;
  return image;
}

std::optional<View> ReadExr(const std::string& path) try {
  Imf::InputFile file(path.c_str(), 0);
  const Imath::Box2i window = file.header().dataWindow();
  const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
  const Imf::ChannelList& present = file.header().channels();
  Imf::FrameBuffer channels;
  const auto want = [&](const char* name, Imf::PixelType type, void* pixels, std::size_t stride) {
    channels.insert(name, Imf::Slice::Make(type, pixels, window, stride));
  };

  View view;
  std::vector<half> colour;
  if (present.findChannel("R")) {
    colour.resize(3 * static_cast<std::size_t>(width) * height);
    want("R", Imf::HALF, colour.data(), 3 * sizeof(half));
    want("G", Imf::HALF, colour.data() + 1, 3 * sizeof(half));
    want("B", Imf::HALF, colour.data() + 2, 3 * sizeof(half));
  }
  if (present.findChannel("Z")) {
    view.depth = DepthImage(width, height);
    want("Z", Imf::FLOAT, view.depth.pixels.data(), sizeof(float));
  }
  if (present.findChannel("label")) {
    view.labels = LabelImage(width, height);
    want("label", Imf::UINT, view.labels.pixels.data(), sizeof(std::uint32_t));
  }
  file.setFrameBuffer(channels);
  file.readPixels(window.min.y, window.max.y);

  if (!colour.empty()) view.colour = ColourImage(width, height);
  for (std::size_t i = 0; i < view.colour.pixels.size(); ++i) {
    view.colour.pixels[i] = {ToByte(colour[3 * i]), ToByte(colour[3 * i + 1]), ToByte(colour[3 * i + 2])};
  }
  return view;
} catch (const std::exception&) {
  return std::nullopt;
}

}  // namespace etude
