#include <plumbline/verify/detail/result.h>

#include <cstddef>
#include <utility>

#include "text.h"

namespace plumbline::verify {

namespace {

template <class Enum>
using Word = std::pair<Enum, std::string_view>;

constexpr Word<CheckKind> kCheckKinds[] = {{CheckKind::other, "other"},
                                           {CheckKind::mean, "mean"},
                                           {CheckKind::agreement, "agreement"},
                                           {CheckKind::variance_ratio, "variance_ratio"},
                                           {CheckKind::proportion, "proportion"},
                                           {CheckKind::image, "image"},
                                           {CheckKind::record_pdf, "record_pdf"},
                                           {CheckKind::weight, "weight"},
                                           {CheckKind::support, "support"},
                                           {CheckKind::finite, "finite"},
                                           {CheckKind::jacobian, "jacobian"},
                                           {CheckKind::inverse, "inverse"},
                                           {CheckKind::jacobian_autodiff, "jacobian_autodiff"},
                                           {CheckKind::integral, "integral"},
                                           {CheckKind::chi_square, "chi_square"},
                                           {CheckKind::reciprocity, "reciprocity"},
                                           {CheckKind::energy, "energy"},
                                           {CheckKind::atoms, "atoms"},
                                           {CheckKind::samples, "samples"},
                                           {CheckKind::strata, "strata"},
                                           {CheckKind::net, "net"},
                                           {CheckKind::replicates, "replicates"},
                                           {CheckKind::calibration, "calibration"},
                                           {CheckKind::stability, "stability"},
                                           {CheckKind::variance, "variance"}};

constexpr Word<Figure> kFigures[] = {{Figure::standard_error, "standard error"},
                                     {Figure::skewness, "skewness of the estimate"},
                                     {Figure::largest_share, "largest share"},
                                     {Figure::rejected, "rejected"},
                                     {Figure::non_finite, "non-finite"},
                                     {Figure::mean_of_a, "mean of a"},
                                     {Figure::mean_of_b, "mean of b"},
                                     {Figure::quantities, "quantities"},
                                     {Figure::variance_of_a, "variance of a"},
                                     {Figure::variance_of_b, "variance of b"},
                                     {Figure::largest_batch_of_a, "largest batch's share of a"},
                                     {Figure::largest_batch_of_b, "largest batch's share of b"},
                                     {Figure::batches, "batches"},
                                     {Figure::error_of_logarithm, "error of the logarithm"},
                                     {Figure::hits, "hits"},
                                     {Figure::at_least, "at least"},
                                     {Figure::at_most, "at most"},
                                     {Figure::pixels_judged, "pixels judged"},
                                     {Figure::histogram_p_value, "p-value of a flat histogram"},
                                     {Figure::points_tried, "points tried"},
                                     {Figure::folds, "folds, seams, rounding"},
                                     {Figure::failing, "failing"},
                                     {Figure::ill_conditioned, "ill-conditioned points"},
                                     {Figure::integral_of_pdf, "integral of the pdf"},
                                     {Figure::integral_error, "error of the integral"},
                                     {Figure::atoms, "atoms"},
                                     {Figure::rejected_share, "rejected share"},
                                     {Figure::rejected_error, "error of the rejected share"},
                                     {Figure::unresolved_share, "unresolved share"},
                                     {Figure::unseen_spike, "largest unseen spike"},
                                     {Figure::pairs_with_value, "pairs with a value"},
                                     {Figure::explained_by_rounding, "explained by rounding"},
                                     {Figure::rounding, "rounding"},
                                     {Figure::evaluations, "evaluations"},
                                     {Figure::chi_square, "chi-square"},
                                     {Figure::degrees_of_freedom, "degrees of freedom"},
                                     {Figure::bins, "bins"},
                                     {Figure::albedo_of_atoms, "from atoms"},
                                     {Figure::other, "other"}};

template <class Enum, std::size_t n>
std::string_view word_of(const Word<Enum> (&words)[n], Enum value) {
  for (const auto& [candidate, word] : words) {
    if (candidate == value) return word;
  }
  return "?";
}

template <class Enum, std::size_t n>
std::optional<Enum> value_of(const Word<Enum> (&words)[n], std::string_view text) {
  for (const auto& [value, word] : words) {
    if (word == text) return value;
  }
  return std::nullopt;
}

void line(std::string& out, std::string_view name, const std::string& text) {
  if (text.empty()) return;
  out += "  " + std::string(name) + std::string(name.size() < 12 ? 12 - name.size() : 1, ' ') +
         text + "\n";
}

std::string if_known(const std::optional<double>& value) {
  return value ? number(*value) : std::string();
}

std::string estimate_line(const CheckResult& r) {
  if (!r.estimate) return {};
  std::string text = number(*r.estimate);
  if (r.interval) {
    text += "  [" + number(r.interval->low) + ", " + number(r.interval->high) + "] (99.9 %)";
  }
  if (r.reference) text += "  against " + number(*r.reference);
  return text;
}

std::string bound_line(const CheckResult& r) {
  if (!r.bound) return {};
  std::string text = number(*r.bound);
  if (r.tolerance) text += "  (tolerance " + number(*r.tolerance) + ")";
  return text;
}

/// Time only where it is long: it differs from run to run.
std::string samples_line(const CheckResult& r) {
  if (r.samples == 0) return {};
  std::string text = number(r.samples);
  if (r.seconds >= 10) text += " in " + number(r.seconds) + " s";
  return text;
}

}  // namespace

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

std::string_view to_string(CheckKind kind) { return word_of(kCheckKinds, kind); }

std::optional<CheckKind> check_kind(std::string_view word) { return value_of(kCheckKinds, word); }

std::string_view to_string(Figure figure) { return word_of(kFigures, figure); }

FigureValue::FigureValue(std::string_view name, double v)
    : figure(value_of(kFigures, name).value_or(Figure::other)), value(v) {
  if (figure == Figure::other) own_name = name;
}

std::string_view FigureValue::name() const {
  return figure == Figure::other ? std::string_view(own_name) : to_string(figure);
}

std::optional<double> CheckResult::figure(Figure wanted) const {
  for (const FigureValue& f : figures) {
    if (f.figure == wanted) return f.value;
  }
  return std::nullopt;
}

std::string describe(const CheckResult& r) {
  std::string out = r.subject + ": " + std::string(to_string(r.kind)) + " check gives " +
                    std::string(to_string(r.verdict));
  out += r.as_expected() ? ", as expected\n"
                         : ", expected " + std::string(to_string(r.expected)) + "\n";
  line(out, "why", r.reason);
  line(out, "advice", r.advice);
  line(out, "diagnosis", r.diagnosis);
  line(out, "estimate", estimate_line(r));
  line(out, "|bias| <=", bound_line(r));
  line(out, "detectable", if_known(r.detectable));
  line(out, "p-value", if_known(r.p_value));
  line(out, "samples", samples_line(r));
  line(out, "leans on", r.leaned_on);
  for (const FigureValue& f : r.figures) line(out, f.name(), number(f.value));
  line(out, "seed", number(r.seed));
  line(out, "replay", r.replay);
  return out;
}

}  // namespace plumbline::verify
