#include "demo/program/options.h"

#include <cassert>
#include <sstream>

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

CLI::Validator between(double least, double most) {
  std::ostringstream bounds;
  bounds << least << " .. " << most;
  const auto check = [least, most, bounds = bounds.str()](const std::string& text) {
    double value = 0;
    const bool within = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
    return within ? std::string() : "should lie in " + bounds + ", is " + text;
  };
  return CLI::Validator(check, "in [" + bounds.str() + "]");
}

CLI::Validator named() {
  return CLI::Validator([](const std::string& text) { return text.empty() ? "should not be empty" : ""; }, "");
}

OutputOption::OutputOption(CLI::App& app, const char* name, const char* about)
    : option_(app.add_option(name, path_, about)->type_name("FILE")->check(named())) {}

void OutputOption::open() {
  if (!path_.empty()) file_.emplace(path_);
}

void OutputOption::commit(const std::string& text) {
  assert(file_ || path_.empty());
  if (file_) file_->commit(text);
}

void OutputOption::commit(const nlohmann::ordered_json& json) {
  assert(file_ || path_.empty());
  if (file_) file_->commit(json);
}

}  // namespace pleat::demo
