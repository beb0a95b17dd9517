// The program `validate`: the library against answers that are known without it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/machine.h"
#include "bench/validation/check.h"
#include "demo/program/entry.h"
#include "demo/program/options.h"
#include "demo/program/progress.h"
#include "engine/pleat.h"

namespace {

using namespace pleat::bench;
namespace demo = pleat::demo;

struct Outcome {
  const Case* which;
  Checks checks;
};

std::vector<const Case*> chosen(const std::vector<std::string>& names, bool quick) {
  std::vector<const Case*> cases;
  for (const Case& c : kCases) {
    const bool named = std::ranges::find(names, c.name) != names.end();
    if (named || (names.empty() && (c.quick || !quick))) cases.push_back(&c);
  }
  return cases;
}

std::vector<Outcome> run_all(const pleat_api& api, const std::vector<const Case*>& cases) {
  demo::Progress progress("validating, case", uint32_t(cases.size()));
  std::vector<Outcome> outcomes;
  for (const Case* c : cases) {
    outcomes.push_back({c, c->run(api)});
    progress.step();
  }
  return outcomes;
}

/// Returns how many gates failed.
int print(const std::vector<Outcome>& outcomes) {
  int failed = 0, gates = 0;
  std::printf("%-44s%14s%14s%11s%11s\n", "", "expected", "measured", "error", "gate");
  for (const Outcome& outcome : outcomes) {
    std::printf("%s: %s\n", outcome.which->name, outcome.which->about);
    for (const Check& check : outcome.checks) {
      std::printf("  %-42s%14.7g%14.7g%11.2g%11.2g  %s\n", check.name.c_str(), check.expected, check.measured,
                  check.error, check.gate, check.pass() ? "pass" : "FAIL");
      ++gates;
      failed += check.pass() ? 0 : 1;
    }
  }
  std::printf("%d of %d gates passed\n", gates - failed, gates);
  return failed;
}

nlohmann::ordered_json as_json(const pleat_api& api, const std::vector<Outcome>& outcomes) {
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (const Outcome& outcome : outcomes) {
    for (const Check& check : outcome.checks) {
      cases.push_back({{"name", std::string(outcome.which->name) + ": " + check.name},
                       {"expected", check.expected},
                       {"measured", check.measured},
                       {"error", check.error},
                       {"gate", check.gate},
                       {"pass", check.pass()}});
    }
  }
  return {{"cases", cases}, {"machine", describe_machine(api)}};
}

int run_program(int argc, char** argv) {
  std::string about =
      "The library against answers that are known without it: closed forms, and the same scheme in double precision.\n"
      "Exits 1 when a gate fails.\n\nCases:";
  std::vector<std::string> known;
  for (const Case& c : kCases) {
    known.push_back(c.name);
    about += std::string("\n  ") + c.name + std::string(20 - known.back().size(), ' ') + c.about;
  }
  CLI::App app(about, "validate");
  std::vector<std::string> names;
  bool quick = false;
  app.add_option("--case", names, "only this one; may be repeated")->type_name("NAME")->check(CLI::IsMember(known));
  app.add_flag("--quick", quick, "only the cases that take no time");
  demo::OutputOption json(app, "--json", "write the figures for scripts");
  if (const auto status = demo::parse(app, argc, argv)) return *status;

  const pleat_api& api = demo::library();
  json.open();
  const std::vector<Outcome> outcomes = run_all(api, chosen(names, quick));
  json.commit(as_json(api, outcomes));
  return print(outcomes) == 0 ? 0 : demo::kOwnFailure;
}

}  // namespace

int main(int argc, char** argv) {
  return pleat::demo::run_main("validate", [=] { return run_program(argc, argv); });
}
