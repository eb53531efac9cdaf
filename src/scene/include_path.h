// Where an `include` leads: paths relative to the top file's folder, which they never leave (contract 2).
//
// '.', '..' and doubled '/' are resolved in the text alone, so that one file has one name and a cycle is seen. Links in
// the file system are the business of who reads the files.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace shodo {

enum class PathProblem : unsigned char {
  kNone,
  kAbsolute,   // starts with '/'
  kForbidden,  // has a backslash or a colon
  kNoFile,     // ends in '/', '.' or '..'
  kOutside,    // leaves the top file's folder
  kTooLong,    // doesn't fit the buffer
};

/// `path` as `including` names it, itself a path relative to the top folder; the result is written to `resolved`,
/// `size` bytes long. Neither may overlap `resolved`.
PathProblem resolve_include(std::string_view including, std::string_view path, std::span<char> resolved,
                            std::size_t& size);

/// What follows the last '/' or '\': the name of a file without its folder.
std::string_view file_name(std::string_view path);

}  // namespace shodo
