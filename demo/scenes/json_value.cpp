#include "demo/scenes/json_value.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "demo/input_error.h"

namespace pleat::demo {
namespace {

constexpr int kDeepest = 64;  // objects and arrays in each other

std::string short_number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

/// What a value is, with its article.
std::string kind(const nlohmann::json& value) {
  const std::string name = value.type_name();
  if (value.is_null()) return name;
  return (value.is_object() || value.is_array() ? "an " : "a ") + name;
}

std::vector<std::string> words(std::initializer_list<std::string_view> list) { return {list.begin(), list.end()}; }

}  // namespace

std::string join(const std::vector<std::string>& list) {
  std::string joined;
  for (const std::string& word : list) joined += (joined.empty() ? "" : ", ") + word;
  return joined;
}

nlohmann::json parse_json(const std::string& text, const std::string& name) {
  std::istringstream stream(text);
  const auto line_at = [&](size_t end) {
    return size_t(1 + std::count(text.begin(), text.begin() + ptrdiff_t(end), '\n'));
  };
  const auto line_read = [&] {  // of what was just read, which the parser may be a character past
    const auto read = std::max<std::streamoff>(1, stream.rdbuf()->pubseekoff(0, std::ios::cur, std::ios::in));
    return line_at(size_t(read - 1));
  };
  std::vector<std::set<std::string>> open;  // the keys so far of each object that is open, by depth
  using Event = nlohmann::json::parse_event_t;
  const auto check = [&](int depth, Event event, const nlohmann::json& value) {
    if (depth >= kDeepest && (event == Event::object_start || event == Event::array_start))
      throw InputError(name, line_read(), "is nested more than " + std::to_string(kDeepest) + " deep");
    if (event == Event::object_start) {
      open.resize(size_t(depth));
      open.emplace_back();
    }
    if (event == Event::key && !open[size_t(depth) - 1].insert(value.get<std::string>()).second)
      throw InputError(name, line_read(), "the key `" + value.get<std::string>() + "` stands here a second time");
    return true;
  };
  try {
    return nlohmann::json::parse(stream, check);
  } catch (const nlohmann::json::parse_error& error) {
    const size_t end = std::min(text.size(), error.byte);
    throw InputError(name, line_at(end), "is not JSON here" + std::string(end >= text.size() ? " (cut short?)" : ""));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(name, line_read(), std::string("is not JSON: ") + error.what());
  }
}

void JsonValue::fail(const std::string& message) const {
  throw InputError(*file_, (pointer_.empty() ? "" : pointer_ + ": ") + message);
}

void JsonValue::allow_keys(std::initializer_list<std::string_view> known) const {
  for (const std::string& key : keys()) {
    if (std::ranges::find(known, key) == known.end()) {
      fail("unknown key `" + key + "`; known are " + join(words(known)));
    }
  }
}

std::vector<std::string> JsonValue::keys() const {
  if (!value_->is_object()) fail("should be an object, is " + kind(*value_));
  std::vector<std::string> found;
  for (const auto& [key, unused] : value_->items()) found.push_back(key);
  return found;
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const {
  if (!value_->is_object()) fail("should be an object, is " + kind(*value_));
  const auto found = value_->find(std::string(key));
  if (found == value_->end()) return std::nullopt;
  return JsonValue(*found, *file_, pointer_ + "/" + std::string(key));
}

JsonValue JsonValue::at(std::string_view key) const {
  const std::optional<JsonValue> found = find(key);
  if (!found) fail("`" + std::string(key) + "` is missing");
  return *found;
}

std::string JsonValue::one_of(std::initializer_list<std::string_view> known) const {
  std::string chosen;
  for (const std::string& key : keys()) {
    if (std::ranges::find(known, key) == known.end()) continue;
    if (!chosen.empty()) fail("has both `" + chosen + "` and `" + key + "`, should have one");
    chosen = key;
  }
  if (chosen.empty()) fail("should have one of " + join(words(known)));
  return chosen;
}

std::vector<JsonValue> JsonValue::items() const {
  if (!value_->is_array()) fail("should be an array, is " + kind(*value_));
  std::vector<JsonValue> found;
  for (size_t i = 0; i < value_->size(); ++i) {
    found.push_back(JsonValue((*value_)[i], *file_, pointer_ + "/" + std::to_string(i)));
  }
  return found;
}

double JsonValue::number(double least, double most) const {
  if (!value_->is_number()) fail("should be a number, is " + kind(*value_));
  const double value = value_->get<double>();
  if (!(value >= least && value <= most)) {
    fail("is " + value_->dump() + ", should lie in " + short_number(least) + " .. " + short_number(most));
  }
  return value;
}

uint32_t JsonValue::integer(uint32_t least, uint32_t most) const {
  if (!value_->is_number_integer()) {
    fail("should be a whole number, is " + (value_->is_number() ? value_->dump() : kind(*value_)));
  }
  return uint32_t(number(least, most));
}

bool JsonValue::boolean() const {
  if (!value_->is_boolean()) fail("should be true or false, is " + kind(*value_));
  return value_->get<bool>();
}

std::string JsonValue::text() const {
  if (!value_->is_string()) fail("should be a text, is " + kind(*value_));
  return value_->get<std::string>();
}

Eigen::Vector3d JsonValue::vector(double least, double most) const {
  const std::vector<JsonValue> parts = items();
  if (parts.size() != 3) fail("should be three numbers, has " + std::to_string(parts.size()));
  return {parts[0].number(least, most), parts[1].number(least, most), parts[2].number(least, most)};
}

}  // namespace pleat::demo
