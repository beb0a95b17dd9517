// What the fuzzer has found worth keeping, played again without it; and as much noise as a test has time for.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "tests/fuzz/host_script.h"

namespace pleat::fuzz {
namespace {

TEST(Fuzz, TheCorpusPlays) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(PLEAT_FUZZ_CORPUS)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_FALSE(files.empty());
  std::uint64_t accepted = 0, refused = 0;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    const Seen seen = play(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    EXPECT_EQ(seen.fault, "") << file;
    accepted += seen.accepted, refused += seen.refused;
  }
  EXPECT_GT(accepted, files.size());
  EXPECT_GT(refused, 0u) << "the corpus has no bad input";
}

TEST(Fuzz, NoisePlays) {
  std::mt19937 random(1);
  for (int run = 0; run < 40; ++run) {
    std::vector<std::uint8_t> bytes(400);
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random() >> 24);
    EXPECT_EQ(play(bytes.data(), bytes.size()).fault, "") << "run " << run;
  }
}

}  // namespace
}  // namespace pleat::fuzz
