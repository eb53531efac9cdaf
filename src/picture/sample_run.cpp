#include "picture/sample_run.h"

namespace shodo {

SampleRun pixels_of(std::int32_t x0, std::int32_t x1, std::uint32_t split) {
  const std::int32_t first = x0 >> split, last = (x1 - 1) >> split, width = 1 << split;
  const std::int32_t from = x0 - (first << split), to = x1 - (last << split);  // within the first and the last pixel
  return {first, last + 1, (first << split) + width / 2, split,
          static_cast<std::uint32_t>((first == last ? to : width) - from), static_cast<std::uint32_t>(to)};
}

bool RunWalk::next(SampleRun& run) {
  if (x_ >= end_) return false;
  const std::int32_t at = x_ >> bits_, width = 1 << bits_, border = (at + 1) << bits_;
  const bool whole = (x_ & (width - 1)) == 0 && border <= end_;
  const std::int32_t last = whole ? end_ >> bits_ : at + 1;
  const std::int32_t stop = whole ? last << bits_ : border < end_ ? border : end_;
  const std::int32_t columns = whole ? width : stop - x_;
  const std::uint32_t weight = static_cast<std::uint32_t>(columns);
  run = {at, last, x_ + columns / 2, bits_, weight, weight};
  x_ = stop;
  return true;
}

EndPixels::EndPixels(const SampleRun& run, std::uint32_t channels, std::uint32_t* sums)
    : run_(run), channels_(channels), first_(sums + static_cast<std::uint32_t>(run.x0) * channels),
      last_(sums + static_cast<std::uint32_t>(run.x1 - 1) * channels) {
  for (std::uint32_t c = 0; c < channels; ++c) {
    before_first_[c] = first_[c];
    before_last_[c] = last_[c];
  }
}

void EndPixels::weigh() const {
  for (std::uint32_t c = 0; c < channels_; ++c) {
    if (last_ != first_) last_[c] = before_last_[c] + ((last_[c] - before_last_[c]) >> run_.bits) * run_.last;
    first_[c] = before_first_[c] + ((first_[c] - before_first_[c]) >> run_.bits) * run_.first;
  }
}

}  // namespace shodo
