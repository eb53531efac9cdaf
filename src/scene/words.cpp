#include "scene/words.h"

#include <span>

#include "base/check.h"
#include "scene/include_path.h"
#include "scene/slice.h"

namespace shodo {

namespace {

constexpr std::size_t kLongestQuote = 32;

void add_quoted(MessageText& message, std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  message.add('\'');
  for (const char c : slice(text, 0, kLongestQuote)) {
    const unsigned byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      message.add(c);
    } else {
      message.add("\\x").add(kHex[byte >> 4]).add(kHex[byte & 15]);
    }
  }
  message.add(text.size() > kLongestQuote ? "...'" : "'");
}

/// Of a longer name it is the end.
void place_at(Status& status, std::string_view file, const Token& at) {
  constexpr std::size_t kRoom = sizeof status.file - 1;
  TextBuilder(status.file, sizeof status.file).add(file.size() > kRoom ? slice(file, file.size() - kRoom) : file);
  status.line = at.line;
  status.column = at.column;
}

std::string_view problem_text(PathProblem problem) {
  switch (problem) {
    case PathProblem::kAbsolute: return "a path relative to this file";
    case PathProblem::kForbidden: return "a path without '\\' and ':'";
    case PathProblem::kNoFile: return "the path of a file";
    case PathProblem::kOutside: return "a path that stays in the folder of the top file";
    case PathProblem::kTooLong: return "shorter paths of the files that include each other";
    case PathProblem::kNone: break;
  }
  return {};
}

}  // namespace

MessageText mistake_at(Status& status, StatusCode code, std::string_view file, const Token& at) {
  status = {};
  status.code = code;
  place_at(status, file, at);
  if constexpr (!features::kMessages) TextBuilder(status.message, sizeof status.message).add(at.text);
  return MessageText(status.message, sizeof status.message);
}

MessageText& add_found(MessageText& message, const Token& token) {
  message.add(", found ");
  if (token.kind == TokenKind::kEndOfLine) return message.add("the end of the line");
  if (token.kind == TokenKind::kEndOfFile) return message.add("the end of the file");
  if (token.kind == TokenKind::kControl) message.add("the control character ");
  add_quoted(message, token.text);
  return message;
}

Words::Words(std::string_view name, std::string_view text, const Reader& reader, Status& status)
    : name_(name), text_(text), reader_(reader), status_(status) {}

bool Words::restart() {
  depth_ = includes_ = 0;
  paths_used_ = 0;
  return open(file_name(name_), text_);
}

Token Words::take() {
  const Token taken = token_;
  token_ = files_[depth_].lexer.next();
  return taken;
}

/// Makes files_[depth_] the current file.
bool Words::open(std::string_view path, std::string_view text) {
  files_[depth_] = {path, Lexer(text)};
  if (text.size() >= 0xffffffff) {
    mistake({}).add("expected a file below 4 GiB");  // lines and columns have 32 bits
    return false;
  }
  take();
  return true;
}

bool Words::resolve(const Token& path, std::string_view& resolved) {
  std::size_t size = 0;
  const std::span<char> free = std::span(paths_).subspan(paths_used_);
  const PathProblem problem = resolve_include(files_[depth_].path, path.text, free, size);
  if (problem != PathProblem::kNone) return expected(path, problem_text(problem));
  resolved = {free.data(), size};
  return true;
}

bool Words::read(const Token& path, std::string_view& resolved, std::string_view& text) {
  if (!resolve(path, resolved)) return false;
  if (reader_.read != nullptr && reader_.read(reader_.context, resolved, text)) return true;
  MessageText message = mistake(path, StatusCode::kFile);
  message.add("expected a file that can be read");
  add_found(message, path);
  return false;
}

bool Words::read_beside(std::string_view file, const Token& path, std::string_view& resolved, std::string_view& text) {
  std::size_t size = 0;
  const std::span<char> free = std::span(paths_).subspan(paths_used_ + file.size());
  const PathProblem problem = resolve_include(file, path.text, free, size);
  resolved = {free.data(), size};
  const bool missing = problem == PathProblem::kNone;  // there is a reader: it gave the file
  if (missing && reader_.read(reader_.context, resolved, text)) return true;
  MessageText message = mistake_in(file, path, missing ? StatusCode::kFile : StatusCode::kScene);
  message.add("expected ").add(missing ? "a file that can be read" : problem_text(problem));
  add_found(message, path);
  return false;
}

bool Words::enter(const Token& path) {
  if (depth_ == kMaxIncludeDepth) return expected(path, "at most 8 files within each other");
  if (includes_ == kMaxIncludes) return expected(path, "at most 1000 includes in all");
  std::string_view resolved;
  if (!resolve(path, resolved)) return false;
  for (std::uint32_t k = 0; k <= depth_; ++k) {
    if (files_[k].path == resolved) return expected(path, "a file that isn't being read already");
  }
  std::string_view text;
  if (!read(path, resolved, text)) return false;
  ++includes_;
  ++depth_;
  paths_used_ += resolved.size();
  return open(resolved, text);
}

void Words::leave() {
  SHODO_CHECK(depth_ > 0);
  paths_used_ -= files_[depth_].path.size();
  --depth_;
  take();
}

void Words::place(const Token& at) { place_at(status_, current_file(), at); }

MessageText Words::mistake(const Token& at, StatusCode code) { return mistake_at(status_, code, current_file(), at); }

MessageText Words::mistake_in(std::string_view file, const Token& at, StatusCode code) {
  return mistake_at(status_, code, file, at);
}

bool Words::expected_other(const Token& at, std::string_view what) {
  MessageText message = mistake(at);
  message.add("expected ").add(what);
  add_found(message, at);
  return false;
}

}  // namespace shodo
