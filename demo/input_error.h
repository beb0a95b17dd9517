#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace pleat::demo {

/// A mistake in a file the user gave: what() reads `file:line: message`, or `file: message` where no line is to blame.
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& file, std::size_t line, const std::string& message)
      : std::runtime_error(file + ":" + std::to_string(line) + ": " + message) {}
  InputError(const std::string& file, const std::string& message) : std::runtime_error(file + ": " + message) {}
};

}  // namespace pleat::demo
