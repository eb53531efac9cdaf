#include "scene/lexer.h"

#include "scene/slice.h"

namespace shodo {

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

bool is_control(char c) {
  const unsigned char byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

Lexer::Lexer(std::string_view text) : text_(text) {
  if (slice(text_, 0, kByteOrderMark.size()) == kByteOrderMark) position_ = line_start_ = kByteOrderMark.size();
}

Token Lexer::token(TokenKind kind, std::size_t size) const {
  return {kind, line_, static_cast<std::uint32_t>(position_ - line_start_ + 1), slice(text_, position_, size)};
}

/// At LF, or at a CR that LF or the end of the text follows.
bool Lexer::at_line_end() const {
  if (text_[position_] == '\n') return true;
  return text_[position_] == '\r' && (position_ + 1 == text_.size() || text_[position_ + 1] == '\n');
}

Token Lexer::next() {
  bool comment = false;
  for (; position_ < text_.size(); ++position_) {
    const char c = text_[position_];
    if (at_line_end()) {
      const Token end = token(TokenKind::kEndOfLine, 0);
      position_ += c == '\r' && position_ + 1 < text_.size() ? 2 : 1;
      line_start_ = position_;
      ++line_;
      return end;
    }
    if (is_blank(c)) continue;
    if (is_control(c)) return token(TokenKind::kControl, 1);
    if (c == '#') comment = true;
    if (!comment) break;
  }
  if (position_ == text_.size()) return token(TokenKind::kEndOfFile, 0);
  std::size_t end = position_;
  while (end < text_.size() && !is_blank(text_[end]) && !is_control(text_[end]) && text_[end] != '#') ++end;
  const Token word = token(TokenKind::kWord, end - position_);
  position_ = end;
  return word;
}

}  // namespace shodo
