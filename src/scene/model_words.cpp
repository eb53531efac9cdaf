#include "scene/model_words.h"

#include "scene/slice.h"

namespace shodo {

ModelWords::ModelWords(Words& words, std::string_view path, std::string_view text)
    : words_(words), path_(path), text_(text), lexer_(text), following_(lexer_.next()) {
  take();
}

bool ModelWords::countable() {
  if (text_.size() < 0xffffffff) return true;
  mistake({}).add("expected a file below 4 GiB");
  return false;
}

Token ModelWords::take() {
  const Token taken = token_;
  while (true) {
    token_ = following_;
    following_ = lexer_.next();
    const bool goes_on = at_word() && following_.kind == TokenKind::kEndOfLine && token_.text.ends_with('\\');
    if (!goes_on) return taken;
    token_.text.remove_suffix(1);
    following_ = lexer_.next();
    if (!token_.text.empty()) return taken;
  }
}

bool ModelWords::next_statement() {
  while (token_.kind == TokenKind::kEndOfLine) take();
  return token_.kind != TokenKind::kEndOfFile;
}

bool ModelWords::skip_statement() {
  while (at_word()) take();
  return end_statement();
}

Token ModelWords::take_name() {
  Token name = take();
  const std::size_t start = static_cast<std::size_t>(name.text.data() - text_.data());
  std::size_t end = start + name.text.size();
  while (at_word()) {
    const Token word = take();
    end = static_cast<std::size_t>(word.text.data() - text_.data()) + word.text.size();
  }
  if (slice(text_, end, 1) == "#") {  // for the Lexer a comment
    std::size_t k = end;
    bool blank = false;
    for (; k < text_.size() && text_[k] != '\n' && text_[k] != '\r' && !(blank && text_[k] == '#'); ++k) {
      blank = text_[k] == ' ' || text_[k] == '\t';
      if (!blank) end = k + 1;
    }
  }
  name.text = slice(text_, start, end - start);
  return name;
}

bool ModelWords::read_number(const What& what, const Interval& allowed, double& value) {
  if (number_of(token_, allowed, value)) {
    take();
    return true;
  }
  MessageText message = mistake(token_);
  add_expected_number(message, token_, what, allowed);
  return false;
}

bool ModelWords::expected(const Token& at, std::string_view what) {
  MessageText message = mistake(at);
  message.add("expected ").add(what);
  add_found(message, at);
  return false;
}

}  // namespace shodo
