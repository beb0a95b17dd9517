// PNG files, shrinking, labels and contact sheets.
#include "demo/picture/image.h"

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "demo/picture/label.h"
#include "demo/picture/sheet.h"

namespace pleat::demo {
namespace {

namespace fs = std::filesystem;

class ImageFile : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("pleat_image_test_" + std::to_string(getpid()));
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {})); }
  static std::string refusal(const fs::path& path, const Image& image) {
    try {
      write_png(path, image);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  }
  fs::path folder;
};

TEST_F(ImageFile, ComesBackAsItWas) {
  for (const std::uint8_t alpha : {std::uint8_t{255}, std::uint8_t{128}}) {
    for (const PngEffort effort : {PngEffort::kFast, PngEffort::kSmall}) {
      Image image = make_image(5, 3, 0x204060ff);
      image.pixel(4, 2)[0] = 255;
      image.pixel(1, 1)[3] = alpha;
      write_png(folder / "a.png", image, effort);
      EXPECT_EQ(files(), 1u);

      png_image png{};
      png.version = PNG_IMAGE_VERSION;
      ASSERT_TRUE(png_image_begin_read_from_file(&png, (folder / "a.png").c_str()));
      EXPECT_EQ(png.format & PNG_FORMAT_FLAG_ALPHA, alpha == 255 ? 0u : PNG_FORMAT_FLAG_ALPHA);
      png.format = PNG_FORMAT_RGBA;
      ASSERT_EQ(png.width, 5u);
      ASSERT_EQ(png.height, 3u);
      std::vector<std::uint8_t> back(image.rgba.size());
      ASSERT_TRUE(png_image_finish_read(&png, nullptr, back.data(), 0, nullptr));
      EXPECT_EQ(back, image.rgba);
    }
  }
}

TEST(Png, MoreEffortMakesSlopesSmaller) {
  Image slope = make_image(256, 256, 0x000000ff);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) slope.pixel(x, y)[0] = static_cast<std::uint8_t>((7 * x + 3 * y) / 10);
  }
  EXPECT_LT(2 * encode_png(slope, PngEffort::kSmall).size(), encode_png(slope, PngEffort::kFast).size());
}

TEST_F(ImageFile, FailureNamesThePathAndLeavesNothing) {
  const Image image = make_image(4, 4, 0xffffffff);
  const fs::path missing = folder / "no such folder" / "a.png";
  EXPECT_NE(refusal(missing, image).find(missing.string()), std::string::npos);
  EXPECT_NE(refusal(missing, image).find("No such file"), std::string::npos);

  fs::create_directories(folder / "taken.png" / "inside");  // the name is a folder: renaming fails
  EXPECT_NE(refusal(folder / "taken.png", image).find("taken.png"), std::string::npos);
  EXPECT_EQ(files(), 1u);
}

TEST_F(ImageFile, OldFileOutlivesAFailure) {
  std::ofstream(folder / "a.png") << "old";
  Image torn = make_image(4, 4, 0xffffffff);
  torn.rgba.pop_back();
  EXPECT_NE(refusal(folder / "a.png", torn), "");
  EXPECT_NE(refusal(folder / "a.png", Image{}), "");
  EXPECT_EQ(fs::file_size(folder / "a.png"), 3u);
  EXPECT_EQ(files(), 1u);
}

TEST(Image, SizeIsChecked) {
  EXPECT_THROW(make_image(0, 5, 0), std::invalid_argument);
  EXPECT_THROW(make_image(5, -1, 0), std::invalid_argument);
  EXPECT_THROW(make_image(16385, 1, 0), std::invalid_argument);
}

TEST(Shrink, AveragesLightNotCodes) {
  Image chequers = make_image(8, 8, 0x000000ff);
  for (int y = 0; y < 8; ++y) {
    for (int x = y % 2; x < 8; x += 2) std::fill_n(chequers.pixel(x, y), 3, std::uint8_t{255});
  }
  const Image small = shrink(chequers, 4);
  EXPECT_EQ(small.width, 4);
  EXPECT_EQ(small.height, 4);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(small.pixel(i, i)[0], 188);  // sRGB of half the light
  EXPECT_EQ(small.pixel(0, 0)[3], 255);
}

TEST(Shrink, KeepsAnEvenColourAndTheProportions) {
  const Image small = shrink(make_image(1280, 720, 0x336699ff), 427);
  EXPECT_EQ(small.height, 240);
  EXPECT_EQ(small.rgba, make_image(427, 240, 0x336699ff).rgba);
  EXPECT_THROW(shrink(small, 428), std::invalid_argument);
  EXPECT_THROW(shrink(small, 0), std::invalid_argument);
}

TEST(Shrink, WeighsPartlyCoveredPixels) {
  Image image = make_image(3, 1, 0x000000ff);  // two pixels out of three: the middle one counts half on each side
  std::fill_n(image.pixel(1, 0), 3, std::uint8_t{255});
  const Image small = shrink(image, 2);
  EXPECT_EQ(small.pixel(0, 0)[0], 156);  // sRGB of a third
  EXPECT_EQ(small.pixel(1, 0)[0], 156);
}

TEST(Label, InksOnlyWhatItClaims) {
  Image paper = make_image(200, 40, 0xffffffff);
  draw_label(paper, "0.53 s gy", 10, 10, 12, 0x000000ff);
  const int right = 10 + static_cast<int>(label_width("0.53 s gy", 12));
  int inked = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 200; ++x) {
      const bool ink = paper.pixel(x, y)[0] < 128;
      inked += ink;
      EXPECT_TRUE(!ink || (x >= 8 && x <= right && y >= 8 && y <= 27)) << x << ' ' << y;
    }
  }
  EXPECT_GT(inked, 100);
}

TEST(Label, EachCharacterIsDrawnAndUnlikeTheOthers) {
  std::vector<std::vector<std::uint8_t>> seen;
  for (char character = ' '; character <= '~'; ++character) {
    Image paper = make_image(32, 40, 0xffffffff);
    draw_label(paper, std::string(1, character), 4, 4, 18, 0x000000ff);
    const bool like_zero = character == 'O';
    EXPECT_EQ(std::ranges::count(seen, paper.rgba), like_zero ? 1 : 0) << character;
    seen.push_back(paper.rgba);
  }
}

TEST(Label, SurvivesAnyByteAndAnyPlace) {
  Image paper = make_image(20, 10, 0xffffffff);
  Image marks = paper;
  draw_label(paper, "\xc3\n", -5, -4, 12, 0x000000ff);
  draw_label(marks, "??", -5, -4, 12, 0x000000ff);
  EXPECT_EQ(paper.rgba, marks.rgba);
  draw_label(paper, "far off", 1000, 1000, 12, 0x000000ff);
  EXPECT_EQ(paper.rgba, marks.rgba);
}

TEST(Sheet, LaysCellsOutInRows) {
  std::vector<Cell> cells;
  for (int i = 0; i < 5; ++i) cells.push_back({make_image(40, 30, 0xff000000u | 0xffu), "x"});
  const Image one_row = contact_sheet({cells[0]}, 1), three = contact_sheet(cells, 3), five = contact_sheet(cells, 9);
  const int margin = one_row.width - 40;  // left and right
  EXPECT_EQ(three.width, margin / 2 + 3 * (40 + margin / 2));
  EXPECT_EQ(five.width, margin / 2 + 5 * (40 + margin / 2));
  EXPECT_EQ(five.height, one_row.height);
  EXPECT_EQ(three.height - margin / 2, 2 * (one_row.height - margin / 2));
  // The fifth picture stands second in the second row, nothing is third.
  const int step = 40 + margin / 2, low = three.height - (one_row.height - margin / 2);
  EXPECT_EQ(three.pixel(margin / 2 + step + 5, low + 5)[1], 0);
  EXPECT_EQ(three.pixel(margin / 2 + 2 * step + 5, low + 5)[1], 255);
}

TEST(Sheet, LongLabelStaysBelowItsPicture) {
  const Image picture = make_image(60, 20, 0xffffffff);
  const Image sheet = contact_sheet({{picture, "far too long for its place"}, {picture, ""}}, 2);
  for (int y = 0; y < sheet.height; ++y) {
    for (int x = sheet.width / 2 + 2; x < sheet.width; ++x) ASSERT_EQ(sheet.pixel(x, y)[0], 255);
  }
}

TEST(Sheet, RefusesNothingAndUnequalPictures) {
  EXPECT_THROW(contact_sheet({}, 3), std::invalid_argument);
  EXPECT_THROW(contact_sheet({{make_image(4, 4, 0), ""}}, 0), std::invalid_argument);
  EXPECT_THROW(contact_sheet({{make_image(4, 4, 0), ""}, {make_image(4, 5, 0), ""}}, 2), std::invalid_argument);
}

}  // namespace
}  // namespace pleat::demo
