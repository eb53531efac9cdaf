// Decimal numbers of the scene file to the nearest double, to even in a tie (contract: scene file).
//
// Library conversions differ: some are off by an ulp, some take "nan", "0x1p3" or the comma of a locale. Here the
// digits are an integer D and the value is D 10^E. Up to 15 digits and powers up to 10^22 both are exact doubles, and
// one IEEE operation rounds correctly. All other tokens are divided as big integers, until 64 bits of the quotient are
// known and whether anything is left. Nothing is approximate. 770 digits and whether more follow decide every case: a
// point half-way between two doubles has at most 767.
//
// Memory: about 700 bytes of stack. A token of n digits takes time in n for the digits and at most some 20,000 steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace shodo {

enum class DecimalError : std::uint8_t {
  none,
  empty,
  not_a_number,  // a digit is missing: "nan", ".", "1e"
  out_of_range,  // rounds to infinity
  trailing,      // a number, and something after it: "1,5", "0x1p3"
};

struct DecimalResult {
  double value = 0;  // 0 unless `error` is none
  DecimalError error = DecimalError::none;
  std::size_t offset = 0;  // of the byte at fault; 0 if the whole token is, its size if there is no fault
};

/// [+-] digits [. digits] [(e|E) [+-] digits], with a digit on at least one side of the point; nothing before or after.
/// A value too small for a denormal is 0 with the token's sign.
DecimalResult parse_decimal(std::string_view token);

/// Decimal digits only, up to 4,294,967,295; false, and `value` as it was, otherwise.
[[nodiscard]] bool parse_unsigned(std::string_view token, std::uint32_t& value);

}  // namespace shodo
