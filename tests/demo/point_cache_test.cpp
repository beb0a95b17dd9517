#include "demo/motion/point_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <sstream>

#include "demo/input_error.h"

namespace pleat::demo {
namespace {

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string file(int32_t points, int32_t samples, const std::vector<float>& positions) {
  std::string bytes("POINTCACHE2\0", 12);
  put(bytes, int32_t{1});
  put(bytes, points);
  put(bytes, 0.0f);
  put(bytes, 1.0f);
  put(bytes, samples);
  for (const float x : positions) put(bytes, x);
  return bytes;
}

PointCache read(const std::string& bytes) {
  std::istringstream stream(bytes);
  return read_point_cache(stream, "a.pc2");
}

TEST(PointCache, GoesInStraightLinesBetweenSamples) {
  const PointCache cache = read(file(1, 3, {0, 0, 0, 2, 4, 6, 2, 0, 0}));
  EXPECT_EQ(cache.at(0.5), (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(cache.at(2.0), (std::vector<float>{2, 0, 0}));
  EXPECT_EQ(cache.at(-1.0), (std::vector<float>{0, 0, 0}));
  EXPECT_EQ(cache.at(99.0), (std::vector<float>{2, 0, 0}));
}

TEST(PointCache, BadFilesAreRefused) {
  const std::string good = file(1, 2, {0, 0, 0, 1, 1, 1});
  EXPECT_NO_THROW(read(good));
  EXPECT_THROW(read(good.substr(0, 20)), InputError);
  EXPECT_THROW(read(good.substr(0, good.size() - 1)), InputError);
  EXPECT_THROW(read("x" + good), InputError);
  EXPECT_THROW(read(file(0, 2, {})), InputError);
  EXPECT_THROW(read(file(1, -1, {})), InputError);
  EXPECT_THROW(read(file(2147483647, 2147483647, {})), InputError);
  try {
    read(file(2, 2, {0, 0, 0, 1, 1, 1, 0, 0, 0, 1, NAN, 1}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a.pc2: sample 1: point 1 is not finite");
  }
}

}  // namespace
}  // namespace pleat::demo
