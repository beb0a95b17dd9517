#include "demo/program/output.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "demo/input_error.h"

namespace pleat::demo {
namespace {

namespace fs = std::filesystem;

std::string part_name(const std::string& name) { return "." + name + ".part" + std::to_string(getpid()); }

bool is_frame(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with("frame_") && name.ends_with(".png");
}

}  // namespace

OutputFile::OutputFile(fs::path path) : path_(std::move(path)) {
  if (path_.filename().empty() || fs::is_directory(path_)) throw InputError(path_.string(), "is a folder, not a file");
  part_ = path_.parent_path() / part_name(path_.filename().string());
  if (!std::ofstream(part_)) throw InputError(path_.string(), "cannot be written");
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  fs::remove(part_, ignored);
}

void OutputFile::commit(const std::string& text) {
  std::ofstream stream(part_, std::ios::binary | std::ios::trunc);
  stream << text << std::flush;
  if (!stream) throw std::runtime_error(path_.string() + ": cannot be written: is the disk full?");
  stream.close();
  fs::rename(part_, path_);
}

OutputFolder::OutputFolder(fs::path folder) : folder_(fs::absolute(std::move(folder)).lexically_normal()) {
  if (folder_.filename().empty()) folder_ = folder_.parent_path();
  for (fs::path at = folder_; !fs::exists(at) && at.has_relative_path(); at = at.parent_path()) made_ = at;
  part_ = folder_ / part_name("pleat");
  std::error_code error;
  fs::create_directories(part_, error);
  if (error) throw InputError(folder_.string(), "cannot be written: " + error.message());
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(part_, ignored);
  if (!made_.empty()) {  // remove() leaves a folder alone that holds something
    for (fs::path at = folder_; fs::remove(at, ignored) && at != made_; at = at.parent_path()) {
    }
  }
}

std::vector<fs::path> OutputFolder::commit() {
  for (const auto& old : fs::directory_iterator(folder_)) {
    if (is_frame(old.path())) fs::remove(old.path());
  }
  std::vector<fs::path> files;
  for (const auto& made : fs::directory_iterator(part_)) files.push_back(folder_ / made.path().filename());
  for (const fs::path& file : files) fs::rename(part_ / file.filename(), file);
  std::ranges::sort(files);
  made_.clear();
  return files;
}

}  // namespace pleat::demo
