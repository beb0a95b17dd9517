#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pleat::demo {

/// 8-bit sRGB with alpha, rows from the top, no padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  // 4 * width * height

  std::uint8_t* pixel(int x, int y) { return rgba.data() + 4 * offset(x, y); }
  const std::uint8_t* pixel(int x, int y) const { return rgba.data() + 4 * offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

inline constexpr int kMostPixels = 16384;  ///< along a side
inline constexpr int kMostDrawn = 8192;    ///< the same, of what is drawn at once

/// An image of one colour, 0xRRGGBBAA. Errors: std::invalid_argument unless both sizes are in 1..kMostPixels.
Image make_image(int width, int height, std::uint32_t rgba);

enum class PngEffort {
  kFast,   ///< for the many frames of a film
  kSmall,  ///< for single pictures: half the bytes, five times the time
};

/// The bytes of a PNG, without alpha where no pixel has any. Errors: std::runtime_error.
std::string encode_png(const Image& image, PngEffort effort);

/// Writes a whole PNG or nothing: the file appears under its name only when complete, an older one stays until then.
/// Errors: std::runtime_error that names the path and the reason.
void write_png(const std::filesystem::path& path, const Image& image, PngEffort effort = PngEffort::kFast);

}  // namespace pleat::demo
