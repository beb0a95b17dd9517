#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pleat::demo {

/// A value in a JSON file that knows where it stands: every complaint is an InputError that names the file and the
/// place, such as `kick.json: /garment/pins/ring: ...`. The document and the name must outlive it.
class JsonValue {
 public:
  JsonValue(const nlohmann::json& document, const std::string& file) : value_(&document), file_(&file) {}

  [[noreturn]] void fail(const std::string& message) const;
  const std::string& file() const { return *file_; }
  const nlohmann::json& raw() const { return *value_; }

  /// Of an object; refuses keys other than `known`.
  void allow_keys(std::initializer_list<std::string_view> known) const;
  std::vector<std::string> keys() const;
  std::optional<JsonValue> find(std::string_view key) const;
  JsonValue at(std::string_view key) const;
  /// The one key of an object that holds exactly one of `known`: the way to say "which kind".
  std::string one_of(std::initializer_list<std::string_view> known) const;

  std::vector<JsonValue> items() const;  ///< of an array
  double number(double least, double most) const;
  uint32_t integer(uint32_t least, uint32_t most) const;
  bool boolean() const;
  std::string text() const;
  Eigen::Vector3d vector(double least = -1e4, double most = 1e4) const;  ///< an array of three numbers

 private:
  JsonValue(const nlohmann::json& value, const std::string& file, std::string pointer)
      : value_(&value), file_(&file), pointer_(std::move(pointer)) {}

  const nlohmann::json* value_;
  const std::string* file_;
  std::string pointer_;
};

/// Parses a whole file; what is no JSON, a key twice in an object or nesting deeper than 64 is an InputError that names
/// the line. `name` stands for the file.
nlohmann::json parse_json(const std::string& text, const std::string& name);

/// "a, b, c".
std::string join(const std::vector<std::string>& words);

}  // namespace pleat::demo
