// The words of a file that a scene names and that is no scene file itself (OBJ, MTL), and the messages about them.
//
// Words are the Lexer's: blanks and tabs part them, '#' ends a line, control characters are refused. A line whose last
// word ends in '\' goes on in the next one. Bytes: sizeof(ModelWords), about 150; nothing of the arena.
#pragma once

#include <string_view>

#include "scene/lexer.h"
#include "scene/values.h"
#include "scene/words.h"

namespace shodo {

class ModelWords {
 public:
  /// `path` and `text`: as Words::read() gave them. Mistakes go to the status of `words`.
  ModelWords(Words& words, std::string_view path, std::string_view text);
  ModelWords(const ModelWords&) = delete;
  ModelWords& operator=(const ModelWords&) = delete;

  /// A file whose lines and columns have 32 bits.
  bool countable();
  /// Goes on to the next line that has anything; false at the end of the file.
  [[nodiscard]] bool next_statement();
  /// Skips the rest of a statement; false, after a message, if there are control characters.
  [[nodiscard]] bool skip_statement();
  /// At the end of a statement; false, after a message, if not.
  [[nodiscard]] bool end_statement() { return at_end() || expected("the end of the line"); }

  const Token& peek() const { return token_; }
  bool at_word() const { return token_.kind == TokenKind::kWord; }
  Token take();
  /// A name up to the end of the line, with the blanks inside and any '#' that doesn't follow one.
  Token take_name();
  bool read_number(const What& what, const Interval& allowed, double& value);

  MessageText mistake(const Token& at) { return words_.mistake_in(path_, at); }
  /// "expected <what>, found <the word>"; always false.
  bool expected(const Token& at, std::string_view what);
  bool expected(std::string_view what) { return expected(token_, what); }

 private:
  bool at_end() const { return token_.kind == TokenKind::kEndOfLine || token_.kind == TokenKind::kEndOfFile; }

  Words& words_;
  std::string_view path_, text_;
  Lexer lexer_;
  Token token_, following_;
};

}  // namespace shodo
