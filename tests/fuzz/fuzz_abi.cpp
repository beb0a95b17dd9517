// The fuzzer: libFuzzer invents bytes, a host plays them. Built by the preset `fuzz`; see tests/README.md.
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/host_script.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  const pleat::fuzz::Seen seen = pleat::fuzz::play(bytes, count);
  if (seen.fault.empty()) return 0;
  std::fprintf(stderr, "%s\n", seen.fault.c_str());
  std::abort();
}
