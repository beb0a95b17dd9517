#include "demo/program/output.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <system_error>

#include "demo/input_error.h"

namespace pleat::demo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kList = "pleat_run.txt";
constexpr const char* kListHead = "Written by `pleat run`, which replaces these files when it writes here again:";

std::string part_name(const std::string& name) { return "." + name + ".part" + std::to_string(getpid()); }

/// Of a name that the file system does not take, or a folder that may not be looked into.
InputError not_writable(const fs::filesystem_error& error) {
  return {error.path1().string(), "cannot be written: " + error.code().message()};
}

/// What is open already, as /dev/stdout: to be written to as it is, wherever it leads.
bool is_open(const fs::path& path) {
  const std::string folder = fs::absolute(path).lexically_normal().parent_path().string();
  return folder == "/dev" || folder.starts_with("/dev/fd") || folder.starts_with("/proc");
}

/// The file that a link ends at, be it there or not.
fs::path follow(fs::path path) {
  constexpr int kMostLinks = 40;  // as Linux has it
  for (int i = 0; i < kMostLinks && fs::is_symlink(path); ++i) path = path.parent_path() / fs::read_symlink(path);
  return path;
}

bool is_frame(const std::string& name) {
  const size_t digits = name.size() - std::min<size_t>(name.size(), 10);  // frame_ and .png
  return digits >= 4 && name.starts_with("frame_") && name.ends_with(".png") &&
         std::all_of(name.begin() + 6, name.end() - 4, [](unsigned char c) { return std::isdigit(c); });
}

bool is_result(const std::string& name) {
  return is_frame(name) || name == "sheet.png" || name == "stages.png" || name == "video.mp4" || name == kList;
}

/// The names in a folder's list; none where it has none or one that we did not write.
std::set<std::string> listed(const fs::path& folder) {
  std::ifstream stream(folder / kList);
  std::set<std::string> names;
  std::string line;
  if (!std::getline(stream, line) || line != kListHead) return names;
  names.insert(kList);
  while (std::getline(stream, line)) names.insert(line);
  return names;
}

}  // namespace

OutputFile::OutputFile(fs::path path) try : path_(std::move(path)) {
  if (path_.filename().empty() || fs::is_directory(path_)) throw InputError(path_.string(), "is a folder, not a file");
  bool writable = false;
  if (fs::exists(path_) && (!fs::is_regular_file(path_) || is_open(path_))) {
    writable = access(path_.c_str(), W_OK) == 0;  // opening a pipe would wait for its reader
  } else {
    path_ = follow(path_);
    part_ = path_.parent_path() / part_name(path_.filename().string());
    writable = bool(std::ofstream(part_));
  }
  if (!writable) throw InputError(path_.string(), "cannot be written");
} catch (const fs::filesystem_error& error) {
  throw not_writable(error);
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!part_.empty()) fs::remove(part_, ignored);
}

void OutputFile::commit(const std::string& bytes) {
  const bool in_place = part_.empty();
  std::ofstream stream(in_place ? path_ : part_, std::ios::binary | (in_place ? std::ios::app : std::ios::trunc));
  stream << bytes;
  stream.close();
  if (!stream) throw std::runtime_error(path_.string() + ": cannot be written: is the disk full?");
  if (!part_.empty()) fs::rename(part_, path_);
}

void OutputFile::commit(const nlohmann::ordered_json& json) {
  commit(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

OutputFolder::OutputFolder(fs::path folder) try : folder_(fs::absolute(std::move(folder)).lexically_normal()) {
  if (folder_.filename().empty()) folder_ = folder_.parent_path();
  if (fs::is_directory(folder_)) earlier();  // for what it refuses
  for (fs::path at = folder_; !fs::exists(at) && at.has_relative_path(); at = at.parent_path()) made_ = at;
  part_ = folder_ / part_name("pleat");
  std::error_code error;
  fs::remove_all(part_, error);  // of a run that was ended, with the same number
  fs::create_directories(part_, error);
  if (error) throw InputError(folder_.string(), "cannot be written: " + error.message());
} catch (const fs::filesystem_error& error) {
  throw not_writable(error);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(part_, ignored);
  if (!made_.empty()) {  // remove() leaves a folder alone that holds something
    for (fs::path at = folder_; fs::remove(at, ignored) && at != made_; at = at.parent_path()) {
    }
  }
}

std::vector<fs::path> OutputFolder::earlier() const {
  const std::set<std::string> ours = listed(folder_);
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (!is_result(name)) continue;
    if (!ours.contains(name) || !fs::is_regular_file(entry.symlink_status()))
      throw InputError(entry.path().string(),
                       "is in the way and not of an earlier run: move it, or name another folder");
    files.push_back(entry.path());
  }
  return files;
}

std::vector<fs::path> OutputFolder::commit() {
  std::vector<fs::path> files;
  for (const auto& made : fs::directory_iterator(part_)) files.push_back(folder_ / made.path().filename());
  std::ranges::sort(files);
  std::ofstream list(part(kList));
  list << kListHead << '\n';
  for (const fs::path& file : files) list << file.filename().string() << '\n';
  list.close();
  if (!list) throw std::runtime_error(folder_.string() + ": cannot be written: is the disk full?");

  for (const fs::path& old : earlier()) fs::remove(old);
  fs::rename(part(kList), folder_ / kList);  // first, so that what follows is known as ours if we are ended within
  for (const fs::path& file : files) fs::rename(part(file.filename().string()), file);
  made_.clear();
  return files;
}

}  // namespace pleat::demo
