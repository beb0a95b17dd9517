#include "demo/picture/image.h"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <system_error>

namespace pleat::demo {
namespace {

std::vector<std::uint8_t> without_alpha(const std::vector<std::uint8_t>& rgba) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), &rgba[i], &rgba[i] + 3);
  return rgb;
}

bool opaque(const std::vector<std::uint8_t>& rgba) {
  for (std::size_t i = 3; i < rgba.size(); i += 4) {
    if (rgba[i] != 255) return false;
  }
  return true;
}

// Returns the reason for a failure, empty on success.
std::string write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) return std::generic_category().message(errno);
  std::string reason;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) reason = std::generic_category().message(errno);
  if (std::fclose(file) != 0 && reason.empty()) reason = std::generic_category().message(errno);
  return reason;
}

}  // namespace

Image make_image(int width, int height, std::uint32_t rgba) {
  if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels) {
    throw std::invalid_argument("image size " + std::to_string(width) + "x" + std::to_string(height) +
                                " is not within 1.." + std::to_string(kMostPixels));
  }
  Image image{width, height, {}};
  image.rgba.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    image.rgba[i] = static_cast<std::uint8_t>(rgba >> (24 - 8 * (i % 4)));
  }
  return image;
}

std::string encode_png(const Image& image, PngEffort effort) {
  if (image.width < 1 || image.height < 1 ||
      image.rgba.size() != 4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
    throw std::runtime_error("the image's size does not match its pixels");
  }
  const bool rgb = opaque(image.rgba);
  const std::vector<std::uint8_t>& pixels = rgb ? without_alpha(image.rgba) : image.rgba;
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = rgb ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  if (effort == PngEffort::kFast) png.flags = PNG_IMAGE_FLAG_FAST;  // zlib level 3, no filter
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels.data(), 0, nullptr))
    throw std::runtime_error(png.message);
  bytes.resize(size);
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image, PngEffort effort) {
  std::string bytes;
  try {
    bytes = encode_png(image, effort);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("cannot write " + path.string() + ": " + error.what());
  }
  std::filesystem::path part = path;
  part += ".part";
  std::string reason = write_file(part, bytes);
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
