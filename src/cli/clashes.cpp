#include "cli/clashes.h"

#include <sys/stat.h>

#include <algorithm>
#include <vector>

#include "cli/output.h"

namespace shodo {

namespace {

/// The one path of a file or folder, or of one that may be made there; empty if there is none, and for what isn't a
/// file or folder.
std::string place_of(std::string name) {
  struct stat found {};
  if (stat(name.c_str(), &found) == 0) {
    return S_ISREG(found.st_mode) || S_ISDIR(found.st_mode) ? real_path(name) : "";
  }
  while (name.size() > 1 && name.back() == '/') name.pop_back();
  const std::size_t slash = name.rfind('/');
  const std::string folder = real_path(slash == std::string::npos ? "." : name.substr(0, slash + 1));
  return folder.empty() ? "" : folder + "/" + name.substr(slash + 1);
}

/// The file behind an output that means what is open already; empty if it is no file.
std::string file_behind(const std::string& name) {
  const int descriptor = named_descriptor(name);
  struct stat found {};
  if (descriptor < 0 || fstat(descriptor, &found) != 0 || !S_ISREG(found.st_mode)) return "";
  return real_path("/proc/self/fd/" + std::to_string(descriptor));
}

}  // namespace

bool outputs_apart(const Arguments& arguments, const std::vector<std::string>& inputs, std::string& mistake) {
  std::vector<std::string> taken, read;
  for (const std::string& input : inputs) read.push_back(place_of(input));
  const bool is_folder = arguments.command == Command::kMap || arguments.command == Command::kReport;
  const std::string folder = is_folder ? place_of(arguments.output) + "/" : "";
  const std::string outputs[] = {arguments.output, arguments.csv, arguments.statistics, arguments.summary};
  for (const std::string& name : outputs) {
    const std::string file = file_behind(name);
    if (file.empty()) continue;
    if (std::find(read.begin(), read.end(), file) != read.end())
      mistake = "the output '" + name + "' is a file that is read";
    taken.push_back(file);
  }
  for (const std::string& name : outputs) {
    const std::string place = name.empty() || named_descriptor(name) >= 0 ? "" : place_of(name);
    if (place.empty()) continue;
    for (const std::string& other : read) {
      if (other == place) mistake = "the output '" + name + "' is a file that is read";
    }
    for (const std::string& other : taken) {
      if (other == place) mistake = "two outputs are one file, found '" + name + "'";
    }
    if (folder.size() > 1 && place.starts_with(folder)) {
      mistake = "the output '" + name + "' lies in the folder that -o makes anew";
    }
    taken.push_back(place);
  }
  return mistake.empty();
}

}  // namespace shodo
