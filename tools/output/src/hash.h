#pragma once

#include <cstdint>
#include <string_view>

namespace plumbline::output {

/// FNV-1a, 64 bits: against mistakes, not against malice.
class Hash {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) value_ = (value_ ^ static_cast<unsigned char>(c)) * 1099511628211u;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037u;
};

}  // namespace plumbline::output
