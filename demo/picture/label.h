#pragma once

#include <cstdint>
#include <string_view>

#include "demo/picture/image.h"

namespace pleat::demo {

/// Width of a line of text in pixels, when capitals are `height` pixels high.
float label_width(std::string_view text, float height);

/// Draws a line of text in our own plain stroke lettering, the top left of its capitals at (x, y), in pixels; tails
/// reach a third of `height` below. What falls outside is left out; what is not printable ASCII shows as a question
/// mark.
void draw_label(Image& image, std::string_view text, float x, float y, float height, std::uint32_t rgba);

}  // namespace pleat::demo
