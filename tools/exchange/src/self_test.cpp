#include <plumbline/exchange/self_test.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/detail/stopwatch.h>

namespace plumbline::exchange {
namespace {

using verify::Channels;
using verify::SampleRecord;
using verify::Uniforms;
using verify::Vec3;

constexpr std::uint64_t kSeed = 1;

/// What is asked for, and what came: the same rows in both.
struct Batch {
  std::vector<Vec3> wo, x;  // wo empty unless a BSDF is asked
  std::vector<Uniforms> u;
  std::vector<std::optional<SampleRecord>> samples;
  std::vector<double> pdfs;
  std::vector<Channels> values;

  explicit Batch(std::size_t count) : x(count), u(count), samples(count), pdfs(count) {}
};

Vec3 direction(verify::Random& random) {
  const double z = 2 * random.uniform() - 1, phi = 2 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Vec3 point(const std::optional<verify::Domain>& domain, verify::Random& random) {
  if (!domain) return direction(random);
  if (domain->size() > 0) {
    return {std::floor(random.uniform() * static_cast<double>(domain->size())), 0, 0};
  }
  return domain->chart().from_square({random.uniform(), random.uniform()});
}

Batch random_batch(std::size_t count, const std::optional<verify::Domain>& domain) {
  verify::Random random(kSeed);
  Batch batch(count);
  if (!domain) batch.wo.resize(count);
  for (Vec3& wo : batch.wo) wo = direction(random);
  for (Vec3& x : batch.x) x = point(domain, random);
  for (Uniforms& u : batch.u) {
    for (double& number : u) number = static_cast<double>(random.uniform_float());
  }
  return batch;
}

/// Rows of a batch, in the order given.
Batch rows_of(const Batch& all, const std::vector<std::size_t>& rows) {
  Batch part(rows.size());
  if (!all.wo.empty()) part.wo.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!all.wo.empty()) part.wo[i] = all.wo[rows[i]];
    part.x[i] = all.x[rows[i]];
    part.u[i] = all.u[rows[i]];
  }
  return part;
}

enum class Kind { sample, pdf, eval };

void ask(Answerer& answerer, Kind kind, Batch& batch) {
  if (kind == Kind::sample) answerer.sample(batch.wo, batch.u, batch.samples);
  if (kind == Kind::pdf) answerer.pdf(batch.wo, batch.x, batch.pdfs);
  if (kind == Kind::eval && answerer.hello().has_eval) {
    batch.values.resize(batch.x.size());
    answerer.eval(batch.wo, batch.x, batch.values);
  }
}

/// Equal but for what vector instructions round otherwise than others.
bool close(double a, double b, double epsilon) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return a == b || std::abs(a - b) <= 64 * epsilon * std::max({1.0, std::abs(a), std::abs(b)});
}

bool close(const Channels& a, const Channels& b, double epsilon) {
  if (a.count != b.count) return false;
  for (std::size_t i = 0; i < a.count; ++i) {
    if (!close(a[i], b[i], epsilon)) return false;
  }
  return true;
}

bool close(const std::optional<SampleRecord>& a, const std::optional<SampleRecord>& b,
           double epsilon) {
  if (!a || !b) return a.has_value() == b.has_value();
  for (std::size_t i = 0; i < 3; ++i) {
    if (!close(a->x[i], b->x[i], epsilon)) return false;
  }
  return close(a->pdf.value_or(0), b->pdf.value_or(0), epsilon) &&
         close(a->weight, b->weight, epsilon) && close(a->mass, b->mass, epsilon);
}

/// The first row of the part that differs from the whole, as a sentence; empty if none does.
std::string difference(const Batch& all, const Batch& part, const std::vector<std::size_t>& rows,
                       double epsilon) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t row = rows[i];
    const char* kind = nullptr;
    if (!close(all.samples[row], part.samples[i], epsilon)) kind = "sample";
    if (!close(all.pdfs[row], part.pdfs[i], epsilon)) kind = "pdf";
    if (!all.values.empty() && !close(all.values[row], part.values[i], epsilon)) kind = "eval";
    if (kind == nullptr) continue;
    return std::string(kind) + " answers otherwise in a batch of " + std::to_string(rows.size()) +
           " than in one of " + std::to_string(all.u.size()) +
           ": a value must depend on its own row alone, and random numbers come from u alone";
  }
  return {};
}

class SelfTest {
 public:
  SelfTest(const AnswererOptions& options, const DomainOf& domain_of,
           const std::function<void(const SelfTestStep&)>& tell)
      : options_(options), domain_of_(domain_of), tell_(tell) {}

  bool run() {
    return step("first line", [&] { return greet(); }) &&
           step("batches of 1 to 1000, in any order", [&] { return small_batches(); }) &&
           step("batches of 1,000,000", [&] { return large_batches(); }) &&
           step("ends when its input does", [&] { return end(); });
  }

 private:
  /// @param act  throws AnswererError for what is wrong; returns what was seen
  template <class Act>
  bool step(const char* what, const Act& act) {
    SelfTestStep done{what, false, {}};
    try {
      done.detail = act();
      done.ok = true;
    } catch (const AnswererError& error) {
      done.detail = error.what();
    }
    tell_(done);
    return done.ok;
  }

  std::string greet() {
    answerer_ = std::make_unique<Answerer>(options_);
    domain_ = domain_of_(answerer_->hello());
    if (domain_) answerer_->set_dimensions(coordinates_of(*domain_));
    const reports::AnswererHello& hello = answerer_->hello();
    return hello.name + ", " + (hello.float64 ? "float64" : "float32") + ", " +
           std::to_string(hello.numbers) + " uniform numbers" + (hello.has_eval ? "" : ", no eval");
  }

  std::string small_batches() {
    Batch all = random_batch(1000, domain_);
    for (const Kind kind : {Kind::eval, Kind::sample, Kind::pdf}) ask(*answerer_, kind, all);
    const double epsilon = answerer_->hello().float64 ? 0x1p-53 : 0x1p-24;
    for (const std::vector<std::size_t>& rows :
         {std::vector<std::size_t>{0}, {999, 1}, {3, 2, 1, 500, 7, 7, 998}}) {
      Batch part = rows_of(all, rows);
      for (const Kind kind : {Kind::pdf, Kind::sample, Kind::eval}) ask(*answerer_, kind, part);
      const std::string wrong = difference(all, part, rows, epsilon);
      if (!wrong.empty()) throw AnswererError(wrong);
    }
    return std::to_string(answerer_->queries()) + " queries";
  }

  std::string large_batches() {
    Batch all = random_batch(kMostValues, domain_);
    std::string times;
    constexpr std::array kNames = {"sample", "pdf", "eval"};
    for (const Kind kind : {Kind::sample, Kind::pdf, Kind::eval}) {
      if (kind == Kind::eval && !answerer_->hello().has_eval) continue;
      const verify::Stopwatch watch;
      ask(*answerer_, kind, all);
      std::array<char, 64> text{};
      std::snprintf(text.data(), text.size(), "%s%s %.0f ns", times.empty() ? "" : ", ",
                    kNames[static_cast<std::size_t>(kind)],
                    watch.seconds() * 1e9 / static_cast<double>(kMostValues));
      times += text.data();
    }
    return times + " a value, the program's own time included";
  }

  std::string end() {
    const std::string wrong = answerer_->finish();
    if (!wrong.empty()) throw AnswererError(wrong);
    return {};
  }

  const AnswererOptions& options_;
  const DomainOf& domain_of_;
  std::optional<verify::Domain> domain_;
  const std::function<void(const SelfTestStep&)>& tell_;
  std::unique_ptr<Answerer> answerer_;
};

}  // namespace

bool self_test(const AnswererOptions& options, const DomainOf& domain_of,
               const std::function<void(const SelfTestStep&)>& tell) {
  return SelfTest(options, domain_of, tell).run();
}

}  // namespace plumbline::exchange
