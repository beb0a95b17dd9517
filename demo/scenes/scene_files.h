#pragma once

#include <istream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace pleat::demo {

/// Names of the scenes that are built into the program, without `.json`.
std::vector<std::string> shipped_scenes();

/// A scene file's text and where it lies: files that it names lie beside it.
class SceneFile {
 public:
  /// A shipped scene's name or a path. Throws InputError when there is neither.
  explicit SceneFile(const std::string& name_or_path);

  const std::string& name() const { return name_; }
  const std::string& text() const { return text_; }

  /// Opens a file beside this one. Throws InputError when it cannot be.
  std::unique_ptr<std::istream> open(const std::string& file) const;
  /// How messages call that file.
  std::string path_of(const std::string& file) const;

 private:
  bool shipped_ = false;
  std::string name_, text_;
};

}  // namespace pleat::demo
