// The words of one text of a scene file (contract 2), each with its line and column.
//
// A word is a run of bytes without blanks, tabs, line ends and '#'; '#' starts a comment, which ends with its line. A
// line ends with LF or CR LF, the last one also with the text. A UTF-8 byte-order mark at the start is skipped and not
// counted. Bytes above 0x7e may stand in comments and words (who reads the word decides); control characters may stand
// nowhere. Lines may be of any length. Nothing is copied.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace shodo {

enum class TokenKind : std::uint8_t { kWord, kEndOfLine, kEndOfFile, kControl };

struct Token {
  TokenKind kind = TokenKind::kEndOfFile;
  std::uint32_t line = 1;    // 1-based
  std::uint32_t column = 1;  // 1-based, in bytes
  std::string_view text;     // of a word, or the one control character
};

class Lexer {
 public:
  Lexer() = default;
  /// The text stays the caller's; below 4 GiB.
  explicit Lexer(std::string_view text);

  /// The next word or end of line; after the end of the text always kEndOfFile, after a control character always that.
  Token next();

 private:
  Token token(TokenKind kind, std::size_t size) const;
  bool at_line_end() const;

  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t line_start_ = 0;
  std::uint32_t line_ = 1;
};

}  // namespace shodo
