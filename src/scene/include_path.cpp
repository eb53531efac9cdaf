#include "scene/include_path.h"

#include "scene/slice.h"

namespace shodo {

namespace {

/// Appends one part of a path, or takes one off for "..".
PathProblem append(std::string_view part, std::span<char> resolved, std::size_t& size) {
  if (part.empty() || part == ".") return PathProblem::kNone;
  if (part == "..") {
    if (size == 0) return PathProblem::kOutside;
    while (size > 0 && resolved[size - 1] != '/') --size;
    if (size > 0) --size;
    return PathProblem::kNone;
  }
  const std::size_t slash = size > 0 ? 1 : 0;
  if (part.size() + slash > resolved.size() - size) return PathProblem::kTooLong;
  if (slash == 1) resolved[size++] = '/';
  for (const char c : part) resolved[size++] = c;
  return PathProblem::kNone;
}

}  // namespace

PathProblem resolve_include(std::string_view including, std::string_view path, std::span<char> resolved,
                            std::size_t& size) {
  size = 0;
  if (path.starts_with('/')) return PathProblem::kAbsolute;
  for (const char c : path) {
    if (c == '\\' || c == ':') return PathProblem::kForbidden;
  }
  const std::string_view file = file_name(path);
  if (file.empty() || file == "." || file == "..") return PathProblem::kNoFile;
  const std::size_t folder = including.size() - file_name(including).size();
  if (folder > resolved.size()) return PathProblem::kTooLong;
  for (; size < folder; ++size) resolved[size] = including[size];
  if (size > 0) --size;  // without the '/'
  while (true) {
    const std::size_t end = path.find('/');
    const PathProblem problem = append(slice(path, 0, end), resolved, size);
    if (problem != PathProblem::kNone || end == std::string_view::npos) return problem;
    path.remove_prefix(end + 1);
  }
}

std::string_view file_name(std::string_view path) {
  const std::size_t slash = path.find_last_of("/\\");
  return slash == std::string_view::npos ? path : slice(path, slash + 1);
}

}  // namespace shodo
