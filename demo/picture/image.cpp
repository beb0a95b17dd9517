#include "demo/picture/image.h"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <system_error>

namespace pleat::demo {
namespace {

// Returns the reason for a failure, empty on success.
std::string write_file(const std::filesystem::path& path, const Image& image) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) return std::generic_category().message(errno);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGBA;
  png.flags = PNG_IMAGE_FLAG_FAST;  // zlib level 3, no filter: our flat backgrounds need no more
  std::string reason;
  if (!png_image_write_to_stdio(&png, file, 0, image.rgba.data(), 0, nullptr)) reason = png.message;
  if (std::fclose(file) != 0 && reason.empty()) reason = std::generic_category().message(errno);
  return reason;
}

}  // namespace

Image make_image(int width, int height, std::uint32_t rgba) {
  constexpr int kMaxSize = 16384;
  if (width < 1 || height < 1 || width > kMaxSize || height > kMaxSize) {
    throw std::invalid_argument("image size " + std::to_string(width) + "x" + std::to_string(height) +
                                " is not within 1.." + std::to_string(kMaxSize));
  }
  Image image{width, height, {}};
  image.rgba.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    image.rgba[i] = static_cast<std::uint8_t>(rgba >> (24 - 8 * (i % 4)));
  }
  return image;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  if (image.width < 1 || image.height < 1 ||
      image.rgba.size() != 4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
    throw std::runtime_error("cannot write " + path.string() + ": the image's size does not match its pixels");
  }
  std::filesystem::path part = path;
  part += ".part";
  std::string reason = write_file(part, image);
  std::error_code error;
  if (reason.empty()) {
    std::filesystem::rename(part, path, error);
    if (error) reason = error.message();
  }
  if (!reason.empty()) {
    std::filesystem::remove(part, error);
    throw std::runtime_error("cannot write " + path.string() + ": " + reason);
  }
}

}  // namespace pleat::demo
