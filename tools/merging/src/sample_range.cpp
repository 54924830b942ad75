#include <plumbline/merging/sample_range.h>

#include <fmt/format.h>

#include <charconv>
#include <numeric>
#include <optional>
#include <string_view>
#include <system_error>

#include <plumbline/renderer/core/errors.h>

namespace plumbline::merging {
namespace {

/// Takes pieces off the front of a text, as long as they are what is expected.
class Pieces {
 public:
  explicit Pieces(std::string_view text) : text_(text) {}

  /// Digits alone: from_chars takes no sign for these types.
  template <class Number>
  bool take(Number& number) {
    const char* end = text_.data() + text_.size();
    const auto parsed = std::from_chars(text_.data(), end, number);
    if (parsed.ec != std::errc()) return false;
    text_.remove_prefix(static_cast<std::size_t>(parsed.ptr - text_.data()));
    return true;
  }

  bool take(char c) {
    if (text_.empty() || text_.front() != c) return false;
    text_.remove_prefix(1);
    return true;
  }

  bool take(Shard& shard) {
    return take(shard.number) && take('/') && take(shard.count) && shard.number >= 1 &&
           shard.number <= shard.count;
  }

  bool take(SampleRange& range) {
    if (!take(range.seed) || !take(':') || !take(range.first) || !take('-') || !take(range.end)) {
      return false;
    }
    return range.first < range.end && (!take('@') || take(range.shard));
  }

  bool empty() const { return text_.empty(); }

 private:
  std::string_view text_;
};

std::string text_of_range(const SampleRange& range) {
  const std::string text = fmt::format("{}:{}-{}", range.seed, range.first, range.end);
  if (range.shard.count == 1) return text;
  return fmt::format("{}@{}/{}", text, range.shard.number, range.shard.count);
}

}  // namespace

Shard parse_shard(const std::string& text) {
  Shard shard;
  Pieces pieces(text);
  if (text.empty() || (pieces.take(shard) && pieces.empty())) return shard;
  throw renderer::InputError(
      fmt::format("--shard {}: must read I/N, the part I from 1 to N of N", text));
}

bool share_pixels(const Shard& a, const Shard& b) {
  // Pixel p with p = a.number − 1 (mod a.count) and the same of b: the Chinese remainder theorem.
  const std::uint32_t common = std::gcd(a.count, b.count);
  return a.number % common == b.number % common;
}

bool overlap(const SampleRange& a, const SampleRange& b) {
  return a.seed == b.seed && a.first < b.end && b.first < a.end && share_pixels(a.shard, b.shard);
}

std::string to_text(const std::vector<SampleRange>& ranges) {
  std::vector<std::string> texts;
  texts.reserve(ranges.size());
  for (const SampleRange& range : ranges) texts.push_back(text_of_range(range));
  return fmt::format("{}", fmt::join(texts, " "));
}

std::vector<SampleRange> parse_ranges(const std::string& text) {
  std::vector<SampleRange> ranges;
  Pieces pieces(text);
  do {
    if (!pieces.take(ranges.emplace_back())) {
      throw renderer::InputError(
          fmt::format("\"{:.60}\" names no samples: it must read SEED:FIRST-END, with @I/N behind "
                      "for a shard",
                      text));
    }
  } while (pieces.take(' '));
  if (pieces.empty()) return ranges;
  throw renderer::InputError(
      fmt::format("\"{:.60}\" says more than which samples there are", text));
}

}  // namespace plumbline::merging
