#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pleat::demo {

/// A text file that appears under its name only when whole.
class OutputFile {
 public:
  /// Throws InputError when nothing can be written there, so that it is known before long work.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Throws std::runtime_error when the disk does not take it.
  void commit(const std::string& text);

 private:
  std::filesystem::path path_, part_;
};

/// A folder of results that appear in it only when all are whole.
class OutputFolder {
 public:
  /// Makes the folder where it is missing. Throws InputError when nothing can be written there.
  explicit OutputFolder(std::filesystem::path folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  /// Where to write a file of this name until commit.
  std::filesystem::path part(const std::string& name) const { return part_ / name; }
  /// Moves everything into the folder and says what is there now. Frames of an earlier run there are removed.
  std::vector<std::filesystem::path> commit();

 private:
  std::filesystem::path folder_, part_;
  std::filesystem::path made_;  // the topmost folder that was missing; empty: none
};

}  // namespace pleat::demo
