#include "demo/program/options.h"

#include <cassert>

#include "demo/program/entry.h"

namespace pleat::demo {

std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  }
  return {};
}

OutputOption::OutputOption(CLI::App& app, const char* name, const char* about)
    : option_(app.add_option(name, path_, about)->type_name("FILE")) {}

void OutputOption::open() {
  if (!path_.empty()) file_.emplace(path_);
}

void OutputOption::commit(const std::string& text) {
  assert(file_ || path_.empty());
  if (file_) file_->commit(text);
}

}  // namespace pleat::demo
