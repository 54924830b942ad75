#include <plumbline/verify/result.h>

namespace plumbline::verify {

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "fail";
    case Verdict::inconclusive:
      return "inconclusive";
  }
  return "?";
}

}  // namespace plumbline::verify
