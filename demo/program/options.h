#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "demo/program/output.h"

namespace pleat::demo {

/// Reads the command line. Returns the status to exit with where the program has nothing left to do: after --help, or
/// after what was wrong has been said on stderr.
std::optional<int> parse(CLI::App& app, int argc, char** argv);

/// A finite number within these bounds (CLI::Range lets nan pass).
CLI::Validator between(double least, double most);

/// Not empty: the name of a file or folder.
CLI::Validator named();

/// An option that names a file to write, as --json FILE.
class OutputOption {
 public:
  OutputOption(CLI::App& app, const char* name, const char* about);
  OutputOption(const OutputOption&) = delete;
  OutputOption& operator=(const OutputOption&) = delete;

  CLI::Option& option() const { return *option_; }
  /// To be called once the command line is read and before long work: see OutputFile.
  void open();
  explicit operator bool() const { return file_.has_value(); }
  /// Nothing where the option was not given.
  void commit(const std::string& text);
  void commit(const nlohmann::ordered_json& json);

 private:
  std::filesystem::path path_;
  CLI::Option* option_;
  std::optional<OutputFile> file_;
};

}  // namespace pleat::demo
