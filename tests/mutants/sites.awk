# Places where the code can be changed by one sign, one per line: FILE LINE COLUMN FROM|TO. Input: C++ files. Comments,
# texts, templates' brackets, directives and compile-time checks are left alone.
BEGIN {
  count = split("<=|<;>=|>;==|!=;!=|==;&&|||;||@&&;+=|-=;-=|+=;++|--;<|<=;>|>=;+|-;-|+;*|/;return true|return false;" \
                "return false|return true;continue|break", rules, ";")
  for (k = 1; k <= count; ++k) {
    rule = rules[k]
    if (rule == "&&|||") { from[k] = "&&"; to[k] = "||"; continue }
    if (rule == "||@&&") { from[k] = "||"; to[k] = "&&"; continue }
    at = index(rule, "|")
    from[k] = substr(rule, 1, at - 1)
    to[k] = substr(rule, at + 1)
  }
}
FNR == 1 { table = 0 }
{
  text = $0
  sub(/\/\/.*/, "", text)
  while (match(text, /"[^"]*"/)) {  # columns stay
    blank = ""
    while (length(blank) < RLENGTH) blank = blank "\047"
    text = substr(text, 1, RSTART - 1) blank substr(text, RSTART + RLENGTH)
  }
  if (text ~ /^ *#|static_assert|^ *template|SHODO_CHECK|operator/) next
  for (k = 1; k <= count; ++k) {
    word = from[k]
    # Operators stand between blanks, but for ++; words end a statement.
    pattern = word ~ /^[a-z]/ ? word ";" : word == "++" ? word : " " word " "
    shift = word ~ /^[a-z]/ || word == "++" ? 0 : 1
    start = 1
    while ((at = index(substr(text, start), pattern)) > 0) {
      print FILENAME, FNR, start + at - 1 + shift, word "|" to[k]
      start += at + length(pattern) - 1
    }
  }
}
