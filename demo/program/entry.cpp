#include "demo/program/entry.h"

#include <cerrno>
#include <csignal>
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
    std::signal(SIGPIPE, SIG_IGN);  // a reader that has left does not keep files from being finished
    const int status = body();
    errno = 0;
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
    if (errno == EPIPE) return kOwnFailure;  // whoever left needs no message
    throw std::runtime_error("stdout: cannot be written");
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return kOwnFailure;
  }
}

}  // namespace pleat::demo
