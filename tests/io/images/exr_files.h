#pragma once

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include <algorithm>
#include <string>

#include "engine/base/image.h"
#include "sim/depth_camera/normals.h"
#include "sim/render/scene.h"

namespace etude {

/// An OpenEXR file, read by OpenEXR channel by channel; a picture is empty if its channel is missing.
class ExrFile {
 public:
  explicit ExrFile(const std::string& path) : file_(path.c_str(), 0), window_(file_.header().dataWindow()) {}

  LabelImage Labels() {
    const DepthImage label = Depth("label");
    LabelImage labels(label.width, label.height);
    std::ranges::transform(label.pixels, labels.pixels.begin(), [](float l) { return static_cast<std::uint32_t>(l); });
    return labels;
  }
  DepthImage Depth(const std::string& channel = "Z") { return Read<float>(Imf::FLOAT, channel); }
  NormalImage Normals() {
    const DepthImage x = Depth("N.X"), y = Depth("N.Y"), z = Depth("N.Z");
    NormalImage normals(x.width, x.height);
    for (std::size_t i = 0; i < normals.pixels.size(); ++i) {
      normals.pixels[i] = {x.pixels[i], y.pixels[i], z.pixels[i]};
    }
    return normals;
  }
  ColourImage Colour() {
    const auto r = Read<half>(Imf::HALF, "R"), g = Read<half>(Imf::HALF, "G"), b = Read<half>(Imf::HALF, "B");
    ColourImage colour(r.width, r.height);
    for (std::size_t i = 0; i < colour.pixels.size(); ++i) {
      colour.pixels[i] = {SrgbOfLinear(r.pixels[i]), SrgbOfLinear(g.pixels[i]), SrgbOfLinear(b.pixels[i])};
    }
    return colour;
  }

 private:
  template <typename Pixel>
  Image<Pixel> Read(Imf::PixelType type, const std::string& channel) {
    if (!file_.header().channels().findChannel(channel)) return {};
    Image<Pixel> image(window_.max.x - window_.min.x + 1, window_.max.y - window_.min.y + 1);
    Imf::FrameBuffer channels;
    channels.insert(channel, Imf::Slice::Make(type, image.pixels.data(), window_, sizeof(Pixel)));
    file_.setFrameBuffer(channels);
    file_.readPixels(window_.min.y, window_.max.y);
    return image;
  }

  Imf::InputFile file_;
  Imath::Box2i window_;
};

}  // namespace etude
