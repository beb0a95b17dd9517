#include "bench/machine.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "build_info.h"

namespace pleat::bench {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

#ifdef __clang__
constexpr char kCompiler[] = __VERSION__;
#else
constexpr char kCompiler[] = "g++ " __VERSION__;
#endif

}  // namespace

nlohmann::ordered_json describe_machine(const pleat_api& api) {
  auto features = nlohmann::ordered_json::array();
  if (api.features & PLEAT_FEATURE_COLLISION) features.push_back("collision");
  if (api.features & PLEAT_FEATURE_SMOOTHING) features.push_back("smoothing");
  return {
      {"cpu", processor()}, {"compiler", kCompiler}, {"flags", kFlags}, {"commit", kCommit}, {"features", features}};
}

}  // namespace pleat::bench
