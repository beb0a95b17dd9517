#pragma once

#include <cstdio>
#include <string>

namespace pleat::bench {

/// A number as printf writes it.
inline std::string number(const char* format, double value) {
  char word[40];
  std::snprintf(word, sizeof word, format, value);
  return word;
}

/// An SVG picture on white, element by element. Pixels, y downwards.
class Svg {
 public:
  Svg(int width, int height, int font_size = 10) {
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" font-family=\"sans-serif\" "
        "font-size=\"%d\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
        width, height, font_size);
  }

  /// An element, as printf writes it, of up to 400 bytes.
  template <class... Values>
  void add(const char* format, Values... values) {
    char line[400];
    std::snprintf(line, sizeof line, format, values...);
    text_ += line;
  }
  /// `anchor` is SVG's text-anchor: start, middle or end. `words` may hold elements.
  void text(double x, double y, const std::string& words, const char* anchor = "start") {
    add("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor);
    text_ += words + "</text>\n";
  }
  void raw(const std::string& element) { text_ += element; }
  std::string finish() const { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

}  // namespace pleat::bench
