#include "demo/scenes/scene_files.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "demo/input_error.h"
#include "demo/scenes/json_value.h"
#include "demo/scenes/shipped_files.h"

namespace pleat::demo {
namespace {

const ShippedFile* find_shipped(std::string_view name) {
  for (const ShippedFile& file : kShippedFiles) {
    if (file.name == name) return &file;
  }
  return nullptr;
}

std::unique_ptr<std::istream> open_path(const std::string& path) {
  auto stream = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*stream || std::filesystem::is_directory(path)) throw InputError(path, "cannot be opened");
  return stream;
}

}  // namespace

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  for (const ShippedFile& file : kShippedFiles) {
    if (file.name.ends_with(".json")) names.emplace_back(file.name.substr(0, file.name.size() - 5));
  }
  return names;
}

SceneFile::SceneFile(const std::string& name_or_path) {
  if (const ShippedFile* shipped = find_shipped(name_or_path + ".json")) {
    shipped_ = true;
    name_ = shipped->name;
    text_ = shipped->bytes;
    return;
  }
  std::error_code ignored;  // such as a name that is too long
  if (!std::filesystem::exists(name_or_path, ignored)) {
    throw InputError(name_or_path,
                     "no such scene; there are " + join(shipped_scenes()) + ", or the path of a JSON file");
  }
  name_ = name_or_path;
  std::ostringstream text;
  text << open_path(name_)->rdbuf();
  text_ = text.str();
}

std::string SceneFile::path_of(const std::string& file) const {
  return shipped_ ? file : (std::filesystem::path(name_).parent_path() / file).string();
}

std::unique_ptr<std::istream> SceneFile::open(const std::string& file) const {
  if (!shipped_) return open_path(path_of(file));
  const ShippedFile* shipped = find_shipped(file);
  if (!shipped) throw InputError(name_, "names `" + file + "`, which is not built into the program");
  return std::make_unique<std::istringstream>(std::string(shipped->bytes));
}

}  // namespace pleat::demo
