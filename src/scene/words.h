// The words of a scene file with everything it includes, in reading order, and the messages about them (contract 2).
//
// One word is looked at before it is taken. Files stand on a stack of at most 1 + kMaxIncludeDepth, without recursion;
// their texts come from the Reader and are not copied, their paths share one buffer. Every message says where, what was
// expected and what was found. Bytes: sizeof(Words), about 1.1 KiB; nothing of the arena.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/text.h"
#include "scene/lexer.h"
#include "shodo/callbacks.h"
#include "shodo/status.h"

namespace shodo {

inline constexpr std::uint32_t kMaxIncludeDepth = 8;    // files within each other below the top file
inline constexpr std::uint32_t kMaxIncludes = 1000;     // in all: eight levels of many includes each would never end
inline constexpr std::size_t kMaxIncludePaths = 512;    // bytes, all files that are open at a time

class Words {
 public:
  /// Everything stays the caller's. Errors go to `status`; functions that return bool then return false.
  Words(std::string_view name, std::string_view text, const Reader& reader, Status& status);
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;

  /// Back to the first word of the top file.
  [[nodiscard]] bool restart();

  const Token& peek() const { return token_; }
  bool at_word() const { return token_.kind == TokenKind::kWord; }
  bool at_end() const { return token_.kind == TokenKind::kEndOfLine || token_.kind == TokenKind::kEndOfFile; }
  Token take();

  /// Goes on with the file that `path` names; the current token must be the end of the statement.
  [[nodiscard]] bool enter(const Token& path);
  /// The file that `path` names, relative to the top file's folder; stands until the next call.
  [[nodiscard]] bool resolve(const Token& path, std::string_view& resolved);
  /// The text of the file that `path` names, which is no scene file; `resolved` as above.
  [[nodiscard]] bool read(const Token& path, std::string_view& resolved, std::string_view& text);
  /// The same for a path that stands in `file`, relative to it; `file` is what read() gave last, and goes on standing.
  [[nodiscard]] bool read_beside(std::string_view file, const Token& path, std::string_view& resolved,
                                 std::string_view& text);
  /// Back to the including file; only at the end of an included one.
  void leave();
  bool included() const { return depth_ > 0; }

  /// A mistake at a word of the current file: the rest of the message is to be added to what is returned.
  MessageText mistake(const Token& at, StatusCode code = StatusCode::kScene);
  /// The same in a file that read() gave.
  MessageText mistake_in(std::string_view file, const Token& at, StatusCode code = StatusCode::kScene);
  /// "expected <what>, found <the word>"; always false.
  bool expected(const Token& at, std::string_view what) {
    return expected_other(at, features::kMessages ? what : std::string_view());
  }
  bool expected(std::string_view what) { return expected(token_, what); }
  /// Gives an error that has a message its position.
  void place(const Token& at);

 private:
  struct File {
    std::string_view path;  // relative to the top file's folder
    Lexer lexer;
  };

  bool open(std::string_view path, std::string_view text);
  std::string_view current_file() const { return depth_ == 0 ? name_ : files_[depth_].path; }
  bool expected_other(const Token& at, std::string_view what);

  std::string_view name_, text_;
  const Reader& reader_;
  Status& status_;
  Token token_;
  std::uint32_t depth_ = 0;
  std::uint32_t includes_ = 0;
  File files_[1 + kMaxIncludeDepth];
  char paths_[kMaxIncludePaths] = {};
  std::size_t paths_used_ = 0;
};

/// A mistake at a word of a file: its place, and the message to which the rest is to be added.
MessageText mistake_at(Status& status, StatusCode code, std::string_view file, const Token& at);
/// Adds ", found <the word>", control characters and other bytes outside ASCII as \xNN, long words cut.
MessageText& add_found(MessageText& message, const Token& token);

}  // namespace shodo
