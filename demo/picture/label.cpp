#include "demo/picture/label.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace pleat::demo {
namespace {

// Plain lettering of straight strokes, from space to tilde. A stroke is a chain of points, two digits each: x to the
// right, y down, on a grid where capitals stand from 0 to 6, small letters from 2 to 6 and tails reach 8. One point
// alone is a dot.
constexpr float kCapHeight = 6;
constexpr std::array<const char*, 95> kStrokes{
    "",                                     // space
    "0004 06",                              // !
    "0001 1011",                            // "
    "1016 3036 0242 0444",                  // #
    "413010010213334445361605 2027",        // $
    "4006 0010110100 3545463635",           // %
    "46112031220405162644",                 // &
    "0001",                                 // '
    "10010516",                             // (
    "00111506",                             // )
    "2125 0442 0244",                       // *
    "0343 2125",                            // +
    "1607",                                 // ,
    "0333",                                 // -
    "06",                                   // .
    "0640",                                 // /
    "103041453616050110",                   // 0
    "011016",                               // 1
    "01103041420646",                       // 2
    "0110304142334445361605 1333",          // 3
    "36300444",                             // 4
    "400002324345361605",                   // 5
    "413010010516364543321203",             // 6
    "004016",                               // 7
    "103041423313020110 1304051636454433",  // 8
    "051636454130100103143443",             // 9
    "03 06",                                // :
    "03 1607",                              // ;
    "310435",                               // <
    "0242 0444",                            // =
    "013405",                               // >
    "01103041422324 26",                    // ?
    "36160501103041443432222434",           // @
    "062046 1333",                          // A
    "06003041423344453606 0333",            // B
    "4130100105163645",                     // C
    "00304145360600",                       // D
    "40000646 0333",                        // E
    "400006 0333",                          // F
    "41301001051636454323",                 // G
    "0006 4046 0343",                       // H
    "0006",                                 // I
    "3035261605",                           // J
    "0006 400346",                          // K
    "000646",                               // L
    "0600234046",                           // M
    "06004640",                             // N
    "103041453616050110",                   // O
    "06003041423303",                       // P
    "103041453616050110 2446",              // Q
    "06003041423303 2346",                  // R
    "413010010213334445361605",             // S
    "0040 2026",                            // T
    "000516364540",                         // U
    "002640",                               // V
    "0016325660",                           // W
    "0046 4006",                            // X
    "002340 2326",                          // Y
    "00400646",                             // Z
    "10000717",                             // [
    "0046",                                 // backslash
    "00101707",                             // ]
    "021022",                               // ^
    "0747",                                 // _
    "0011",                                 // `
    "3322120305162635 3236",                // a
    "0006 0312223335261605",                // b
    "3322120305162635",                     // c
    "3036 3322120305162635",                // d
    "04343322120305162635",                 // e
    "30201116 0232",                        // f
    "3237281807 3322120305162635",          // g
    "0006 0312223336",                      // h
    "0206 00",                              // i
    "121708 10",                            // j
    "0006 320436",                          // k
    "000516",                               // l
    "0206 0312223336 3342526366",           // m
    "0206 0312223336",                      // n
    "122233352616050312",                   // o
    "0208 0312223335261605",                // p
    "3238 3322120305162635",                // q
    "0206 031222",                          // r
    "33221203142435261605",                 // s
    "10152636 0232",                        // t
    "0205162635 3236",                      // u
    "022642",                               // v
    "0216325662",                           // w
    "0236 3206",                            // x
    "0226 4218",                            // y
    "02320636",                             // z
    "20110213152627",                       // {
    "0007",                                 // |
    "00112213152607",                       // }
    "0413233342",                           // ~
};

using Point = Eigen::Vector2f;

// Calls visit(a, b) for each straight piece of a character; a dot has a = b.
template <class Visit>
void for_each_piece(char character, const Visit& visit) {
  const int index = character - ' ';
  const std::string_view chains = kStrokes[static_cast<std::size_t>(index >= 0 && index < 95 ? index : '?' - ' ')];
  const auto point = [chains](std::size_t i) {
    return Point(static_cast<float>(chains[i] - '0'), static_cast<float>(chains[i + 1] - '0'));
  };
  for (std::size_t first = 0; first < chains.size();) {
    const std::size_t end = std::min(chains.find(' ', first), chains.size());
    if (end - first == 2) visit(point(first), point(first));
    for (std::size_t i = first; i + 2 < end; i += 2) visit(point(i), point(i + 2));
    first = end + 1;
  }
}

float advance(char character) {
  float right = 2;  // of a space
  if (character != ' ') right = 0;
  for_each_piece(character, [&right](const Point& a, const Point& b) { right = std::max({right, a.x(), b.x()}); });
  return right + 2;
}

// Covers pixels within half a pen's width of the segment, with a soft edge of one pixel.
void draw_piece(Image& image, const Point& a, const Point& b, float pen, std::uint32_t rgba) {
  const float reach = pen / 2 + 1;
  const Point low = a.cwiseMin(b).array() - reach, high = a.cwiseMax(b).array() + reach;
  const int left = std::max(0, static_cast<int>(low.x())),
            right = std::min(image.width - 1, static_cast<int>(high.x()));
  const int top = std::max(0, static_cast<int>(low.y())),
            bottom = std::min(image.height - 1, static_cast<int>(high.y()));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const Point p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const float t = std::clamp((p - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-9f), 0.0f, 1.0f);
      const float cover = std::clamp(pen / 2 + 0.5f - (a + t * (b - a) - p).norm(), 0.0f, 1.0f);
      for (int c = 0; c < 3; ++c) {
        std::uint8_t& channel = image.pixel(x, y)[c];
        const auto ink = static_cast<float>((rgba >> (24 - 8 * c)) & 255);
        const auto paper = static_cast<float>(channel);
        channel = static_cast<std::uint8_t>(std::lround(paper + cover * (ink - paper)));
      }
    }
  }
}

}  // namespace

float label_width(std::string_view text, float height) {
  float width = 0;
  for (const char character : text) width += advance(character);
  return width * height / kCapHeight;
}

void draw_label(Image& image, std::string_view text, float x, float y, float height, std::uint32_t rgba) {
  const float scale = height / kCapHeight;
  for (const char character : text) {
    for_each_piece(character, [&](const Point& a, const Point& b) {
      draw_piece(image, Point(x, y) + scale * a, Point(x, y) + scale * b, 0.13f * height, rgba);
    });
    x += scale * advance(character);
  }
}

}  // namespace pleat::demo
