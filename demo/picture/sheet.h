#pragma once

#include <string>
#include <vector>

#include "demo/picture/image.h"

namespace pleat::demo {

/// The image shrunk to `width` pixels, proportions kept: each pixel is the average, in linear light, of the area that
/// it covers. Errors: std::invalid_argument unless 1 <= width <= image.width.
Image shrink(const Image& image, int width);

struct Cell {
  Image image;
  std::string label;  // one line below the picture; ASCII
};

struct SheetSize {
  int width, height;  // pixels
};

/// Of a contact sheet of `count` pictures of this size in rows of `columns`.
SheetSize sheet_size(int count, int columns, int width, int height);

/// Pictures in rows of `columns`, from the top left, each with its label, on white.
/// Errors: std::invalid_argument when there is no cell, no column, or pictures differ in size.
Image contact_sheet(const std::vector<Cell>& cells, int columns);

}  // namespace pleat::demo
