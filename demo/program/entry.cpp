#include "demo/program/entry.h"

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "demo/input_error.h"
#include "demo/program/progress.h"

namespace pleat::demo {

const pleat_api& library() {
  const pleat_api* api = pleat_get_api(PLEAT_API_MAJOR);
  if (!api) throw std::runtime_error("libpleat does not speak version " + std::to_string(PLEAT_API_MAJOR));
  return *api;
}

int run_main(const char* program, const std::function<int()>& body) {
  try {
    catch_interrupt();
    return body();
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return kOwnFailure;
  }
}

}  // namespace pleat::demo
