#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace pleat::demo {

/// A file that appears under its name only when whole. Where the name is a link, what it points at is written; a pipe
/// or a device is written into.
class OutputFile {
 public:
  /// Throws InputError when nothing can be written there, so that it is known before long work.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Throws std::runtime_error when the disk does not take it.
  void commit(const std::string& bytes);
  /// As text; bytes of names that are no UTF-8, which JSON cannot hold, are replaced by U+FFFD.
  void commit(const nlohmann::ordered_json& json);

 private:
  std::filesystem::path path_, part_;  // part_ empty: path_ is written into
};

/// A folder of pictures that appear in it only when all are whole, with pleat_run.txt, a list of them. What the list of
/// an earlier run names is replaced; other files are left alone.
class OutputFolder {
 public:
  /// Makes the folder where it is missing. Throws InputError when nothing can be written there, or when a file that is
  /// not of an earlier run has a name that a run may write: frame_NNNN.png, sheet.png, stages.png, video.mp4,
  /// pleat_run.txt.
  explicit OutputFolder(std::filesystem::path folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  /// Where to write a file of this name until commit.
  std::filesystem::path part(const std::string& name) const { return part_ / name; }
  /// Removes what an earlier run wrote, moves everything into the folder and says what that is, without the list.
  /// Throws as the constructor does.
  std::vector<std::filesystem::path> commit();

 private:
  /// The files of an earlier run that are there.
  std::vector<std::filesystem::path> earlier() const;

  std::filesystem::path folder_, part_;
  std::filesystem::path made_;  // the topmost folder that was missing; empty: none
};

}  // namespace pleat::demo
