#include "sim/sensors/image_files.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <png.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace etude {
namespace {

Result<void> WriteBytes(const std::string& bytes, const std::string& path) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (file.fail()) return Fail({path}, "cannot be written: {}", std::strerror(errno));
  return {};
}

// Where OpenEXR puts a file's bytes.
class ByteStream : public Imf::OStream {
 public:
  ByteStream() : Imf::OStream("a picture in memory") {}

  void write(const char* data, int count) override {
    const std::size_t end = at_ + static_cast<std::size_t>(count);
    if (bytes_.size() < end) bytes_.resize(end);
    std::memcpy(bytes_.data() + at_, data, static_cast<std::size_t>(count));
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }
  std::string TakeBytes() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

// Throws what OpenEXR throws.
void WriteExr(const View& view, Imf::OStream& out) {
  const int width = std::max({view.colour.width, view.depth.width, view.labels.width});
  const int height = std::max({view.colour.height, view.depth.height, view.labels.height});
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  const Imath::Box2i& window = header.dataWindow();
  Imf::FrameBuffer channels;
  const auto add = [&](const char* name, Imf::PixelType type, const void* pixels, std::size_t stride) {
    header.channels().insert(name, Imf::Channel(type));
    channels.insert(name, Imf::Slice::Make(type, pixels, window, stride));
  };

  std::vector<half> colour;
  for (const Rgb8& pixel : view.colour.pixels) {
    for (const std::uint8_t value : {pixel.r, pixel.g, pixel.b}) colour.push_back(half(value / 255.0f));
  }
  if (!colour.empty()) {
    add("R", Imf::HALF, colour.data(), 3 * sizeof(half));
    add("G", Imf::HALF, colour.data() + 1, 3 * sizeof(half));
    add("B", Imf::HALF, colour.data() + 2, 3 * sizeof(half));
  }
  if (!view.depth.pixels.empty()) add("Z", Imf::FLOAT, view.depth.pixels.data(), sizeof(float));
  if (!view.labels.pixels.empty()) add("label", Imf::UINT, view.labels.pixels.data(), sizeof(std::uint32_t));

  Imf::OutputFile file(out, header, 0);
  file.setFrameBuffer(channels);
  file.writePixels(height);
}

}  // namespace

std::string EncodePng(const ColourImage& image) {
  assert(image.width > 0 && image.height > 0);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  const int written = png_image_write_to_memory(&png, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr);
  assert(written && "the buffer has the size of the worst case");
  bytes.resize(written ? size : 0);
  return bytes;
}

Result<std::string> EncodeExr(const View& view) {
  try {
    ByteStream stream;
    WriteExr(view, stream);
    return stream.TakeBytes();
  } catch (const std::exception& error) {
    return Fail({}, "cannot be written as OpenEXR: {}", error.what());
  }
}

Result<void> SaveExr(const View& view, const std::string& path) {
  const auto bytes = EncodeExr(view);
  if (!bytes) return Fail({path}, "{}", bytes.error().message);
  return WriteBytes(*bytes, path);
}

}  // namespace etude
