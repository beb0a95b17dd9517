// world_state_size, world_save and world_load at the border.
#include "tests/abi/host.h"

namespace pleat::abi {
namespace {

TEST_F(Host, AStateIsSavedAndLoaded) {
  std::uint64_t bytes = 0;
  ASSERT_EQ(api().world_state_size(world, &bytes), pleat_result{PLEAT_OK});
  std::vector<char> saved(bytes + 16, 'x');
  ASSERT_EQ(api().world_save(world, saved.data(), saved.size()), pleat_result{PLEAT_OK});
  EXPECT_EQ(std::string(saved.end() - 16, saved.end()), std::string(16, 'x')) << "written beyond the state";
  const std::vector<float> before = state();
  for (int i = 0; i < 5; ++i) ASSERT_EQ(api().world_step(world, 0.02f), pleat_result{PLEAT_OK});
  const std::vector<float> after = state();
  EXPECT_NE(after, before);
  ASSERT_EQ(api().world_load(world, saved.data(), bytes), pleat_result{PLEAT_OK});
  EXPECT_EQ(state(), before);
  for (int i = 0; i < 5; ++i) ASSERT_EQ(api().world_step(world, 0.02f), pleat_result{PLEAT_OK});
  EXPECT_EQ(state(), after);
}

TEST_F(Host, StatesAreChecked) {
  std::uint64_t bytes = 0;
  ASSERT_EQ(api().world_state_size(world, &bytes), pleat_result{PLEAT_OK});
  std::vector<char> saved(bytes + 1);
  expect_refused(PLEAT_ERROR_ARGUMENT, "bytes", [&] { return api().world_state_size(world, nullptr); });
  expect_refused(PLEAT_ERROR_ARGUMENT, "to", [&] { return api().world_save(world, nullptr, bytes); });
  expect_refused(PLEAT_ERROR_CAPACITY, "capacity", [&] { return api().world_save(world, saved.data(), bytes - 1); });
  EXPECT_EQ(saved, std::vector<char>(bytes + 1));
  ASSERT_EQ(api().world_save(world, saved.data(), bytes), pleat_result{PLEAT_OK});
  expect_refused(PLEAT_ERROR_ARGUMENT, "from", [&] { return api().world_load(world, nullptr, bytes); });
  expect_refused(PLEAT_ERROR_ARGUMENT, "bytes", [&] { return api().world_load(world, saved.data(), 0); });
  for (const std::uint64_t wrong : {bytes - 1, bytes + 1}) {
    expect_refused(PLEAT_ERROR_ARGUMENT, "size in bytes", [&] { return api().world_load(world, saved.data(), wrong); });
  }
  saved[0] ^= 1;
  expect_refused(PLEAT_ERROR_ARGUMENT, "magic number", [&] { return api().world_load(world, saved.data(), bytes); });
  EXPECT_EQ(api().world_state_size(nullptr, &bytes), pleat_result{PLEAT_ERROR_ARGUMENT});
  EXPECT_EQ(api().world_save(nullptr, saved.data(), bytes), pleat_result{PLEAT_ERROR_ARGUMENT});
  EXPECT_EQ(api().world_load(nullptr, saved.data(), bytes), pleat_result{PLEAT_ERROR_ARGUMENT});
}

}  // namespace
}  // namespace pleat::abi
