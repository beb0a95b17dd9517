#include "demo/picture/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "demo/picture/label.h"

namespace pleat::demo {
namespace {

constexpr int kMargin = 10;       // pixels, around cells
constexpr int kLabelHeight = 12;  // of capitals; less where a label would be wider than its picture
constexpr std::uint32_t kPaper = 0xffffffff;
constexpr std::uint32_t kInk = 0x30343aff;

float to_linear(std::uint8_t value) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) {
      const float srgb = static_cast<float>(i) / 255;
      linear[i] = srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
    }
    return linear;
  }();
  return table[value];
}

std::uint8_t to_srgb(float linear) {
  const float srgb = linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(srgb, 0.0f, 1.0f)));
}

// The source pixels below one target pixel along an axis, and how much of each.
struct Span {
  int first;
  std::vector<float> weights;  // sum 1
};

std::vector<Span> box_filter(int from, int to) {
  std::vector<Span> spans;
  const double scale = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    const double begin = i * scale, end = std::min((i + 1) * scale, static_cast<double>(from));
    Span span{static_cast<int>(begin), {}};
    for (int k = span.first; k < end; ++k) {
      span.weights.push_back(static_cast<float>((std::min(end, k + 1.0) - std::max<double>(begin, k)) / (end - begin)));
    }
    spans.push_back(std::move(span));
  }
  return spans;
}

void paste(Image& target, const Image& source, int left, int top) {
  for (int y = 0; y < source.height; ++y) {
    std::copy_n(source.pixel(0, y), 4 * source.width, target.pixel(left, top + y));
  }
}

}  // namespace

Image shrink(const Image& image, int width) {
  if (width < 1 || width > image.width) {
    throw std::invalid_argument("cannot shrink a picture of width " + std::to_string(image.width) + " to " +
                                std::to_string(width));
  }
  const int height =
      std::max(1, static_cast<int>(std::lround(static_cast<double>(image.height) * width / image.width)));
  const std::vector<Span> columns = box_filter(image.width, width), rows = box_filter(image.height, height);
  Image small = make_image(width, height, 0x000000ff);
  std::vector<std::array<float, 3>> line(static_cast<std::size_t>(image.width));  // rows of a target pixel, averaged
  for (int y = 0; y < height; ++y) {
    const Span& row = rows[static_cast<std::size_t>(y)];
    std::ranges::fill(line, std::array<float, 3>{});
    for (std::size_t k = 0; k < row.weights.size(); ++k) {
      const std::uint8_t* source = image.pixel(0, row.first + static_cast<int>(k));
      for (std::size_t x = 0; x < line.size(); ++x) {
        for (std::size_t c = 0; c < 3; ++c) line[x][c] += row.weights[k] * to_linear(source[4 * x + c]);
      }
    }
    for (int x = 0; x < width; ++x) {
      const Span& column = columns[static_cast<std::size_t>(x)];
      for (std::size_t c = 0; c < 3; ++c) {
        float sum = 0;
        for (std::size_t k = 0; k < column.weights.size(); ++k) {
          sum += column.weights[k] * line[static_cast<std::size_t>(column.first) + k][c];
        }
        small.pixel(x, y)[c] = to_srgb(sum);
      }
    }
  }
  return small;
}

SheetSize sheet_size(int count, int columns, int width, int height) {
  columns = std::min(columns, count);
  const int rows = (count + columns - 1) / columns;
  return {kMargin + columns * (width + kMargin), kMargin + rows * (height + kMargin + 2 * kLabelHeight)};
}

Image contact_sheet(const std::vector<Cell>& cells, int columns) {
  if (cells.empty() || columns < 1) throw std::invalid_argument("a contact sheet needs a picture and a column");
  const Image& first = cells.front().image;
  for (const Cell& cell : cells) {
    if (cell.image.width != first.width || cell.image.height != first.height) {
      throw std::invalid_argument("contact sheet: picture '" + cell.label + "' differs in size from the first");
    }
  }
  const int count = static_cast<int>(cells.size());
  columns = std::min(columns, count);
  const int step_x = first.width + kMargin, step_y = first.height + kMargin + 2 * kLabelHeight;
  const SheetSize size = sheet_size(count, columns, first.width, first.height);
  Image sheet = make_image(size.width, size.height, kPaper);
  for (int i = 0; i < count; ++i) {
    const Cell& cell = cells[static_cast<std::size_t>(i)];
    const int left = kMargin + i % columns * step_x, top = kMargin + i / columns * step_y;
    paste(sheet, cell.image, left, top);
    const float fit = static_cast<float>(first.width) / label_width(cell.label, 1);
    draw_label(sheet, cell.label, static_cast<float>(left) + 1, static_cast<float>(top + first.height) + 7.5f,
               std::min(kLabelHeight * 1.0f, fit), kInk);
  }
  return sheet;
}

}  // namespace pleat::demo
